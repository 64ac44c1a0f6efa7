// Joint paths as programs and back: axis maps, the grammar of each dialect, round trips, and what is refused.
#include <catch2/catch.hpp>
#include <regex>
#include <sstream>

#include "base/error.h"
#include "base/write_file.h"
#include "robot/load_robot.h"
#include "robot/program.h"
#include "unit/robot/arms.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Matchers::Contains;
using units::deg;

namespace {

constexpr Dialect all[] = {Dialect::rapid, Dialect::krl, Dialect::urscript, Dialect::ls, Dialect::csv};

const Robot& six_axis() {
  static const auto robot = load_robot("builtin:six_axis");
  return *robot;
}

JointPath random_path(int count, unsigned seed) {
  Random random(seed);
  JointPath path;
  for (int i = 0; i < count; ++i) path.push_back(random_values(six_axis(), random));
  return path;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Each line matches the pattern of its state; a pattern with `*` in front may repeat.
void check_grammar(const std::string& text, const std::vector<std::string>& patterns) {
  INFO(text);
  std::size_t at = 0;
  int repeated = 0;
  for (const std::string& line : lines_of(text)) {
    const auto fits = [&](std::size_t k) {
      return k < patterns.size() && std::regex_match(line, std::regex(patterns[k].substr(patterns[k][0] == '*')));
    };
    CAPTURE(line);
    if (at < patterns.size() && patterns[at][0] == '*' && !fits(at) && repeated > 0) ++at, repeated = 0;
    REQUIRE(fits(at));
    if (patterns[at][0] == '*')
      ++repeated;
    else
      ++at, repeated = 0;
  }
  if (at < patterns.size() && repeated > 0) ++at;
  CHECK(at == patterns.size());
}

const std::string number = "-?[0-9]+\\.[0-9]+";
const std::string six = number + "(?:," + number + "){5}";

}  // namespace

TEST_CASE("axis maps: there and back, FANUC's coupled axis", "[robot]") {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    AxisMap map = AxisMap::same(6);
    std::vector<double> q;
    for (int k = 0; k < 6; ++k) {
      map.sign[k] = random.below(2) ? 1 : -1;
      map.zero[k] = random.in(-3, 3);
      q.push_back(random.in(-3, 3));
    }
    map.coupling = random.in(-1, 1);
    const std::vector<double> back = map.joints(map.shown(q));
    for (int k = 0; k < 6; ++k) CHECK(back[k] == Approx(q[k]).margin(1e-14));
  }
  // The third number on FANUC's pendant is the forearm's rise over the level: leaning the upper arm changes it, unless the
  // elbow makes up for that.
  const AxisMap fanuc = usual_axes(six_axis(), Dialect::ls);
  for (double lean : {-0.5, 0.0, 0.8})
    for (double elbow : {-1.0, 0.0, 0.4}) {
      const std::vector<double> q = {0.3, lean, elbow, 0, 0, 0};
      const Vec3 forearm = six_axis().link_frame(six_axis().link("link_4"), q).d1();
      CHECK(fanuc.shown(q)[2] == Approx(std::asin(forearm.z())).margin(1e-12));
      CHECK(fanuc.shown(q)[1] == lean);
    }
  // KUKA's arm stands stretched to the front at zero.
  const AxisMap kuka = usual_axes(six_axis(), Dialect::krl);
  const std::vector<double> zero = kuka.joints(std::vector<double>(6, 0.0));
  const Vec3 shoulder = six_axis().link_frame(six_axis().link("link_2"), zero).at,
             elbow = six_axis().link_frame(six_axis().link("link_3"), zero).at;
  CHECK((elbow - shoulder - Vec3(1.02, 0, 0)).norm() < 1e-12);
  CHECK((six_axis().link_frame(six_axis().link("link_4"), zero).d1() - Vec3::UnitX()).norm() < 1e-12);
  const std::vector<double> turned = kuka.joints(std::vector<double>{0.1, 0, 0, 0, 0, 0});
  CHECK(turned[0] == Approx(-0.1));  // clockwise seen from above
  CHECK_THROWS_WITH(usual_axes(planar_arm({1, 1}), Dialect::ls), Contains("give the axis map"));
  CHECK_THROWS_WITH((AxisMap{{1, 1}, {0}, 0}).check(2), Contains("got 2 signs and 1 zeros, expected 2 each"));
  CHECK_THROWS_WITH((AxisMap{{1, 2}, {0, 0}, 0}).check(2), Contains("a sign is 2"));
  CHECK_THROWS_WITH((AxisMap{{1, 1}, {0, std::nan("")}, 0}).check(2), Contains("a zero is nan"));
  CHECK_THROWS_WITH((AxisMap{{1, 1}, {0, 0}, 1}).check(2), Contains("three joints"));
}

TEST_CASE("programs: read back, they are the path", "[robot]") {
  for (Dialect dialect : all)
    for (unsigned seed = 1; seed <= 10; ++seed) {
      CAPTURE(name_of(dialect), seed);
      const JointPath path = random_path(1 + 3 * seed, seed);
      const std::string text = write_program(six_axis(), path, {.dialect = dialect, .zone = seed % 2 * 0.02});
      const JointPath back = read_program(six_axis(), text, "x", dialect, {});
      REQUIRE(back.size() == path.size());
      for (std::size_t i = 0; i < path.size(); ++i)
        for (int k = 0; k < 6; ++k) CHECK(std::abs(back[i][k] - path[i][k]) < (dialect == Dialect::ls ? 1.01e-4 * deg : 1e-7));
      // What was read writes the same program.
      if (dialect != Dialect::ls && dialect != Dialect::krl && dialect != Dialect::rapid)
        CHECK(read_program(six_axis(), write_program(six_axis(), back, {.dialect = dialect}), "x", dialect, {}) == back);
    }
}

TEST_CASE("programs: the grammar of RAPID", "[robot]") {
  const JointPath path = random_path(4, 3);
  check_grammar(write_program(six_axis(), path, {.dialect = Dialect::rapid, .name = "weld", .zone = 0.01}),
                {"MODULE weld", "*  CONST jointtarget p[0-9]+:=\\[\\[" + six + "\\],\\[9E9(,9E9){5}\\]\\];",
                 "  CONST zonedata corner:=\\[FALSE,10.0,15.0,15.0,1.50,15.0,1.50\\];", "  PROC main\\(\\)",
                 "    MoveAbsJ p1,v100,fine,tool0;", "*    MoveAbsJ p[23],v100\\\\T:=[0-9]+\\.[0-9]{3},corner,tool0;",
                 "    MoveAbsJ p4,v100\\\\T:=[0-9]+\\.[0-9]{3},fine,tool0;", "  ENDPROC", "ENDMODULE"});
  const std::string plain = write_program(six_axis(), path, {.dialect = Dialect::rapid});
  CHECK(plain.find("corner") == plain.npos);
  // The time is that of the joint that takes longest at the share of speed.
  const JointPath turn = {{0, 0, 0, 0, 0, 0}, {1.1, 0.1, 0, 0, 0, 0}};
  CHECK_THAT(write_program(six_axis(), turn, {.dialect = Dialect::rapid, .speed = 0.25}),
             Contains("\\T:=2.292,"));  // 1.1/(0.25 x 110 deg/s)
}

TEST_CASE("programs: the grammar of KRL, URScript, LS and CSV", "[robot]") {
  const JointPath path = random_path(4, 4);
  std::string axes = "A1 " + number;
  for (int k = 2; k <= 6; ++k) axes += ",A" + std::to_string(k) + " " + number;
  check_grammar(write_program(six_axis(), path, {.dialect = Dialect::krl, .name = "weld", .speed = 0.4}),
                {"DEF weld\\(\\)", "  BAS\\(#INITMOV,0\\)", "  BAS\\(#VEL_PTP,10\\)", "  PTP \\{" + axes + "\\}",
                 "  BAS\\(#VEL_PTP,40\\)", "*  PTP \\{" + axes + "\\}", "END"});
  const std::string smooth = write_program(six_axis(), path, {.dialect = Dialect::krl, .zone = 0.02});
  CHECK(std::regex_search(smooth, std::regex("\\$APO\\.CPTP=[0-9]+\n  PTP \\{" + axes + "\\} C_PTP\n")));

  const std::string list = number + "(?:, " + number + "){5}";
  check_grammar(
      write_program(six_axis(), path, {.dialect = Dialect::urscript, .name = "weld", .zone = 0.02}),
      {"def weld\\(\\):", "  movej\\(\\[" + list + "\\], a=0.5, v=0.2\\)",
       "*  movej\\(\\[" + list + "\\], t=[0-9.]+, r=0\\.0[0-9]+\\)", "  movej\\(\\[" + list + "\\], t=[0-9.]+\\)", "end"});

  const std::string j = "= +" + number + " deg";
  check_grammar(write_program(six_axis(), {path[0], path[1]}, {.dialect = Dialect::ls, .name = "weld", .speed = 0.6}),
                {"/PROG  WELD",
                 "/ATTR",
                 "*(OWNER|COMMENT|PROG_SIZE|FILE_NAME|VERSION|LINE_COUNT|MEMORY_SIZE|PROTECT)\t+= .*;",
                 "TCD:  STACK_SIZE\t= 0,",
                 "*      [A-Z_]+\t= [0-9]+[,;]",
                 "DEFAULT_GROUP\t= 1,\\*,\\*,\\*,\\*;",
                 "CONTROL_CODE\t= 00000000 00000000;",
                 "/MN",
                 "   1:J P\\[1\\] 10% FINE    ;",
                 "   2:J P\\[2\\] 60% FINE    ;",
                 "/POS",
                 "P\\[1\\]\\{",
                 "   GP1:",
                 "\tUF : 0, UT : 1,",
                 "\tJ1" + j + ",\tJ2" + j + ",\tJ3" + j + ",",
                 "\tJ4" + j + ",\tJ5" + j + ",\tJ6" + j,
                 "\\};",
                 "P\\[2\\]\\{",
                 "   GP1:",
                 "\tUF : 0, UT : 1,",
                 "\tJ1" + j + ",\tJ2" + j + ",\tJ3" + j + ",",
                 "\tJ4" + j + ",\tJ5" + j + ",\tJ6" + j,
                 "\\};",
                 "/END"});
  CHECK_THAT(write_program(six_axis(), path, {.dialect = Dialect::ls, .zone = 10}), Contains("P[2] 50% CNT99"));
  check_grammar(write_program(six_axis(), path, {.dialect = Dialect::csv}),
                {"joint_1 \\(deg\\),.*,joint_6 \\(deg\\)", "*" + six});
  // No -0.
  for (Dialect dialect : all)
    CHECK(write_program(six_axis(), {{-1e-12, 0, 0, 0, 0, 0}}, {.dialect = dialect}).find("-0.0000") == std::string::npos);
}

TEST_CASE("programs written by others", "[robot]") {
  const auto read = [](const std::string& text, Dialect dialect) {
    return read_program(six_axis(), text, "job", dialect, AxisMap::same(6));
  };
  const auto near = [](const std::vector<double>& q, std::vector<double> expected) {
    for (int k = 0; k < 6; ++k) CHECK(q[k] / deg == Approx(expected[k]).margin(1e-9));
  };
  JointPath path = read(
      "%%%\n  VERSION:1\n%%%\nMODULE m ! a comment; MoveL p9\n"
      "  LOCAL CONST jointtarget home := [[0,-10,20.5,0,30,+1e1],\n    [9E+09,9E9,9E9,9E9,9E9,9E9]];\n"
      "  PROC move_it()\n    MoveAbsJ home\\NoEOffs, v1000, z50, tool1\\WObj:=wobj0;\n    TPWrite \"move on; MoveL\";\n"
      "    MOVEABSJ [[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v5,fine,tool0;\n  ENDPROC\n  PERS jointtarget "
      "late:=[[6,5,4,3,2,1],[0,0,0,0,0,0]];\n"
      "  PROC two() MoveAbsJ \\Conc, late,v5,fine,tool0; ENDPROC\nENDMODULE\n",
      Dialect::rapid);
  REQUIRE(path.size() == 3);
  near(path[0], {0, -10, 20.5, 0, 30, 10});
  near(path[1], {1, 2, 3, 4, 5, 6});
  near(path[2], {6, 5, 4, 3, 2, 1});

  path = read(
      "&ACCESS RVP\nDEF job( )\nDECL E6AXIS first={A1 1.0,A2 2.0,A3 3.0,A4 4.0,A5 5.0,A6 6.0,E1 0.0}\n;FOLD LIN "
      "comment\n$VEL_AXIS[1]=50\n"
      "PTP first\nptp {a2 -9, E1 100} c_ptp ; only the second\nPTP {AXIS: A1 0, A2 1, A3 2, A4 3, A5 4, A6 5} C_PTP\nEND\n",
      Dialect::krl);
  REQUIRE(path.size() == 3);
  near(path[0], {1, 2, 3, 4, 5, 6});
  near(path[1], {1, -9, 3, 4, 5, 6});
  near(path[2], {0, 1, 2, 3, 4, 5});

  path = read(
      "def job():\n  # movel(p[0,0,0,0,0,0])\n  global q1 = [d2r(10), d2r(-20), 0, 0, 0, 3.141592653589793]\n  "
      "set_tcp(p[0,0,0,0,0,0])\n  movej(q1, a=1.4, v=1.05)\n"
      "  movej([0,0,0,0,0,d2r(90)],1.4,1.05,0,0)\nend\n",
      Dialect::urscript);
  REQUIRE(path.size() == 2);
  near(path[0], {10, -20, 0, 0, 0, 180});
  near(path[1], {0, 0, 0, 0, 0, 90});

  path = read(
      "/PROG  JOB\n/ATTR\nCOMMENT = \"x\";\n/MN\n   1:  !go home ;\n   2:J P[7:home] 100% FINE    ;\n   3:  CALL GRIP    ;\n   "
      "4:J P[2] 5% CNT100 ACC80   ;\n/POS\n"
      "P[2]{\n   GP1:\n\tUF : 0, UT : 2,\n\tJ1=   1.000 deg,\tJ2=   2.000 deg,\tJ3=   3.000 deg,\n\tJ4=   4.000 deg,\tJ5=   "
      "5.000 deg,\tJ6=   6.000 deg\n};\n"
      "P[7:\"home\"]{\n   GP1:\n\tUF : 0, UT : 2,\n\tJ1 = -1.000 deg,\tJ2 = -2.000 deg,\tJ3 = -3.000 deg,\n\tJ4 = -4.000 "
      "deg,\tJ5 = -5.000 deg,\tJ6 = -6.000 deg\n};\n/END\n",
      Dialect::ls);
  REQUIRE(path.size() == 2);
  near(path[0], {-1, -2, -3, -4, -5, -6});
  near(path[1], {1, 2, 3, 4, 5, 6});

  for (const char* text :
       {"j1,j2,j3,j4,j5,j6\n1,2,3,4,5,6\n", "# a comment\n1; 2; 3; 4; 5; 6\n", "1\t2\t3\t4\t5\t6", "  1 2  3 4 5   6  \r\n"}) {
    path = read(text, Dialect::csv);
    REQUIRE(path.size() == 1);
    near(path[0], {1, 2, 3, 4, 5, 6});
  }
  CHECK(read_program(six_axis(), "1,2,3,4,5,6", "x", Dialect::csv, {}, false)[0][5] == 6);
}

TEST_CASE("programs from files; KRL's positions may stand in the file beside", "[robot]") {
  std::string pattern = (std::filesystem::temp_directory_path() / "tendril_program_XXXXXX").string();
  REQUIRE(::mkdtemp(pattern.data()) != nullptr);
  write_file(pattern + "/job.src", "DEF job()\nPTP xp1\nEND\n");
  CHECK_THROWS_WITH(read_program_file(six_axis(), pattern + "/job.src", Dialect::krl, AxisMap::same(6)),
                    Contains("'xp1' is not declared"));
  write_file(pattern + "/job.dat", "DEFDAT job\nDECL AXIS XP1={A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}\nENDDAT\n");
  CHECK(read_program_file(six_axis(), pattern + "/job.src", Dialect::krl, AxisMap::same(6))[0][1] == Approx(2 * deg));
  const JointPath path = random_path(5, 9);
  write_file(pattern + "/job.ls", write_program(six_axis(), path, {.dialect = Dialect::ls}));
  CHECK(read_program_file(six_axis(), pattern + "/job.ls", Dialect::ls, {}).size() == 5);
  std::filesystem::remove_all(pattern);
}

TEST_CASE("programs: what would be lost or cannot be is refused with its line", "[robot]") {
  const auto refused = [](Dialect dialect, const std::string& text, const std::string& line, const std::string& why) {
    CAPTURE(text);
    CHECK_THROWS_AS(read_program(six_axis(), text, "job", dialect, {}), UsageError);
    CHECK_THROWS_WITH(read_program(six_axis(), text, "job", dialect, {}),
                      Contains("program 'job" + line + "': ") && Contains(why));
  };
  refused(Dialect::rapid, "", "", "no moves");
  refused(Dialect::rapid, "MODULE m\nPROC main()\n MoveAbsJ p1,v5,fine,tool0;", ":3", "'p1' is not declared");
  refused(Dialect::rapid, "PROC a()\nENDPROC;\nMoveL p1,v5,fine,tool0;", ":3", "only MoveAbsJ");
  refused(Dialect::rapid, "PROC moves() MoveJ p1,v5,fine,tool0;", ":1", "only MoveAbsJ");
  refused(Dialect::rapid, "MoveAbsJ [[1,2,3],[9E9]],v5;", ":1", "a jointtarget of 3 axes, expected 6");
  refused(Dialect::rapid, "\nCONST jointtarget p:=[[1,2,x,4,5,6],[9E9]];", ":2", "got 'x', expected a finite number");
  refused(Dialect::rapid, "CONST jointtarget p:=5;", ":1", "expected a jointtarget");
  refused(Dialect::krl, "DEF x()\nLIN {X 1}", ":2", "only PTP to axes");
  refused(Dialect::krl, "PTP {X 1,Y 2,Z 3,A 4,B 5,C 6}", ":1", "moves to places are not read");
  refused(Dialect::krl, "\n\nPTP home", ":3", "'home' is not declared");
  refused(Dialect::krl, "PTP {A1 1,A2 2}", ":1", "the first point leaves axes out");
  refused(Dialect::krl, "PTP {A1 1,A2 2,A3 3,A4 4,A5 5,A9 6}", ":1", "no axis 'a9'");
  refused(Dialect::krl, "PTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 inf}", ":1", "finite");
  refused(Dialect::urscript, "def a():\n movel([0,0,0,0,0,0])", ":2", "only movej");
  refused(Dialect::urscript, "movej(p[0,0,0,0,0,0])", ":1", "moves to places");
  refused(Dialect::urscript, "movej([0,0,0])", ":1", "a list of 3 joints, expected 6");
  refused(Dialect::urscript, "movej(q)", ":1", "'q' are not set");
  refused(Dialect::urscript, "movej(", ":1", "not set");
  refused(Dialect::ls, "hello", ":1", "no LS program");
  refused(Dialect::ls, "/MN\n 1:L P[1] 100mm/sec FINE ;\n/POS\n", ":2", "only joint moves");
  refused(Dialect::ls, "/MN\n 1:J PR[1] 100% FINE ;\n/POS\n", ":2", "only moves to positions P[]");
  refused(Dialect::ls, "/MN\n 1:J P[1] 100% FINE ;\n/POS\nP[1]{\nX = 5 mm\n};", ":2", "not given by its joints");
  refused(Dialect::ls, "/MN\n 1:J P[1] 100% FINE ;\n/POS\nP[1]", ":4", "without { and }");
  refused(Dialect::csv, "1,2,3\n", ":1", "a row of 3 numbers, expected 6");
  refused(Dialect::csv, "a,b\nc,d,e,f,g,h\n", ":2", "expected a finite number");

  const JointPath good = {{0, 0, 0, 0, 0, 0}};
  const auto unwritten = [&](const JointPath& path, const ProgramOptions& options, const std::string& why) {
    CHECK_THROWS_WITH(write_program(six_axis(), path, options), Contains(why));
  };
  unwritten({}, {}, "no points");
  unwritten({{0, 0}}, {}, "point 1: got 2 joint values");
  unwritten({good[0], {0, 2, 0, 0, 0, 0}}, {}, "point 2: beyond the joint limits: 'joint_2' at 2");
  unwritten(good, {.speed = 0}, "the speed is 0");
  unwritten(good, {.speed = 1.1}, "the speed is 1.1");
  unwritten(good, {.zone = -1}, "the zone is -1");
  for (const char* name : {"", "1a", "a b", "abcdefghijklmnopqrstuvwxyz"}) unwritten(good, {.name = name}, "expected a letter");
  unwritten(good, {.axes = AxisMap::same(5)}, "got 5 signs");
  const Robot planar = planar_arm({1, 1});
  CHECK_THROWS_WITH(write_program(planar, {{0, 0}}, {}), Contains("only csv"));
  CHECK(write_program(planar, {{0, units::pi / 2}}, {.dialect = Dialect::csv}) ==
        "joint_1 (deg),joint_2 (deg)\n0.0000000,90.0000000\n");
  CHECK_THROWS_WITH(write_program(*arm(), {good[0], good[0]}, {}), Contains("velocity of joint 'joint_1' is not stated"));
  CHECK_THROWS_WITH(read_program_file(six_axis(), "none.src", Dialect::krl, {}), Contains("none.src"));
  CHECK(dialect_of_file("a/B.MOD") == Dialect::rapid);
  CHECK(dialect_of_file("x.src") == Dialect::krl);
  CHECK_THROWS_WITH(dialect_of_file("x.doc"), Contains("'.doc' are not known"));
  CHECK(dialect_named("ls") == Dialect::ls);
  CHECK_THROWS_WITH(dialect_named("rapids"), Contains("did you mean 'rapid'"));
}
