// What a stranger's script cannot do in the sandbox, and what it still can.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "process.h"

namespace fs = std::filesystem;
using cli::Folder;
using cli::Outcome;
using cli::run;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

constexpr int out_of_time = 124;
const char* const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const char* const hose =
    "local s = scene.new{}\n"
    "local hose = rod.new{length = 1, segments = 20, section = rod.section{outer = 0.02, material = rod.material{young = 5e6, poisson = 0.4, "
    "density = 1000}}}\n"
    "s:rod('a', hose, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.8, 0, 0}, along = {1, 0, 0}}})\n";

/// A folder box/ with a script and a mesh, beside a mesh and a text that are none of its business.
struct Box {
  Box() {
    fs::create_directory(folder.path() + "/box");
    folder.file("secret.obj", triangle);
    folder.file("secret.lua", "print('secret')");
    folder.file("box/mesh.obj", triangle);
    fs::create_symlink("../secret.obj", folder.path() + "/box/link.obj");
  }
  Outcome operator()(const std::string& code, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> arguments{"--sandbox"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.push_back(folder.file("box/s.lua", code));
    return run(arguments);
  }
  bool has(const std::string& name) const { return fs::exists(folder.path() + "/" + name); }

  Folder folder;
};

/// Ends with an error of the script that contains `words`.
void refuses(const Box& box, const std::string& code, const std::string& words) {
  INFO(code);
  const Outcome o = box(code);
  CHECK(o.code == 1);
  CHECK_THAT(o.err, StartsWith("tendril: ") && Contains(words));
}

}  // namespace

TEST_CASE("the sandbox has no way to files, programs or compiled code in Lua") {
  const Box box;
  const auto [code, words] = GENERATE(table<std::string, std::string>({
      {"io.open('/etc/passwd')", "(global 'io')"},
      {"os.execute('id')", "(field 'execute')"},
      {"os.getenv('HOME')", "(field 'getenv')"},
      {"os.remove('mesh.obj')", "(field 'remove')"},
      {"os.exit(0)", "(field 'exit')"},
      {"debug.getregistry()", "(global 'debug')"},
      {"package.loadlib('x', 'y')", "(global 'package')"},
      {"dofile('../secret.lua')", "(global 'dofile')"},
      {"loadfile('../secret.lua')", "(global 'loadfile')"},
      {"string.dump(function() end)", "(field 'dump')"},
      {"(''):dump()", "(method 'dump')"},
      {"assert(load('\\27Lua'))", "attempt to load a binary chunk"},
      {"assert(load('x', 'x', 'b'))", "binary chunks are not loaded"},
      {"require 'io'", "module 'io' not found"},
      {"require 'debug'", "module 'debug' not found"},
      {"assert(require('os').execute)", "assertion failed"},
      {"require '../../secret'", "not found"},
      {"package = {path = '../?.lua', searchpath = function() return '../secret.lua' end} require 'secret'", "module 'secret' not found"},
      {"getmetatable('').__index = nil", "attempt to index a string value"},
      {"setmetatable('', {})", "table expected"},
      {"collectgarbage('stop')", "'stop' is not allowed in the sandbox"},
      {"collectgarbage('setpause', 1000)", "'setpause' is not allowed in the sandbox"},
      {"getmetatable(vec(1, 2, 3)).__gc = nil", "attempt to index a string value"},
  }));
  refuses(box, code, words);
}

TEST_CASE("in the sandbox files are read only below the folder") {
  const Box box;
  const std::string outside = GENERATE(as<std::string>(), "../secret.obj", "link.obj", "/etc/passwd", "x/../../secret.obj", "/no/such.obj");
  const std::string refused = "cannot read '" + outside + "': outside of '";
  refuses(box, "scene.mesh('" + outside + "', {unit = 'm'})", refused);
  refuses(box, "scene.new{}:obstacle('a', '" + outside + "', {unit = 'm'})", refused);
  refuses(box, "robot.load('" + outside + "')", refused);
  refuses(box, "study.motion('" + outside + "', {unit = 'm'})", refused);
  refuses(box, "robot.load('builtin:six_axis'):read_program('" + outside + "', {dialect = 'csv'})", refused);
  refuses(box, "scene.import('../secret.kbl')", "cannot read '../secret.kbl': outside of '");
  CHECK(box("print(scene.mesh('mesh.obj', {unit = 'm'}).vertices[2].x)").out == "1.0\n");
}

TEST_CASE("files that a mesh names are read only below the folder") {
  const Box box;
  std::string bytes(36, '\0');
  bytes[3] = bytes[19] = bytes[35] = '@';  // (2, 0, 0), (0, 2, 0), (0, 0, 2)
  box.folder.file("points.bin", bytes);
  const auto gltf = [](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
           R"("buffers":[{"byteLength":36,"uri":")" + uri + R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
           R"("componentType":5126,"count":3,"type":"VEC3"}]})";
  };
  box.folder.file("box/out.gltf", gltf("../points.bin"));
  box.folder.file("box/in.gltf", gltf("points.bin"));
  refuses(box, "scene.mesh('out.gltf', {unit = 'm'})", "mesh 'out.gltf': ");
  box.folder.file("box/points.bin", bytes);
  CHECK(box("print(#scene.mesh('in.gltf', {unit = 'm'}).triangles)").out == "1\n");

  box.folder.file("box/arm.urdf", "<robot><link name='a'><visual><geometry><mesh filename='../secret.obj'/></geometry></visual></link></robot>");
  refuses(box, "robot.load('arm.urdf')", "there is no mesh file");
  box.folder.file("box/scene.wrl", "#VRML V2.0 utf8\nInline { url \"../secret.wrl\" }\n");
  box.folder.file("secret.wrl", "#VRML V2.0 utf8\nShape { geometry Box {} }\n");
  refuses(box, "scene.mesh('scene.wrl', {unit = 'm'})", "secret.wrl");
}

TEST_CASE("in the sandbox files are written only below the folder") {
  const Box box;
  const std::string refused = "cannot write '../out";
  refuses(box, "scene.mesh('mesh.obj', {unit = 'm'}):save('../out.stl')", refused);
  refuses(box, std::string(hose) + "s:export('../out.glb', {equilibrium = s:solve{}})", refused);
  refuses(box, std::string(hose) + "study.chart{kind = 'lines', series = {{name = 'a', x = {1, 2}, y = {1, 2}}}}:save('../out.svg')", refused);
  refuses(box, std::string(hose) + "view.new{s, s:solve{}}:save('../out.png', {size = {64, 64}})", refused);
  refuses(box, std::string(hose) + "method.variation(s, {outcomes = 2, vary = {['a.length'] = {tolerance = 0.01}}, "
                                   "measure = {l = function(e) return 1 end}, store = '../out.sqlite'})", refused);
  for (const char* file : {"out.stl", "out.glb", "out.svg", "out.png", "out.sqlite"}) CHECK_FALSE(box.has(file));
  CHECK(box("scene.mesh('mesh.obj', {unit = 'm'}):save('deep/out.stl') print('done')").out == "done\n");
  CHECK(box.has("box/deep/out.stl"));
}

TEST_CASE("what charts say is never a command") {
  const Box box;
  const Outcome o = box("local evil = \"`touch pwned`\\n!touch pwned\\nsystem('touch pwned')\\n\\\"; system \\\"touch pwned\\\" \\\\140touch pwned\\\\140 @x ' \\\\\"\n"
                        "print(study.chart{kind = 'lines', title = evil, x_label = evil, y_label = evil, series = {{name = evil, x = {1, 2}, y = {1, 2}}}}"
                        ":save('c.svg').ok)\n");
  CHECK(o.out == "true\n");
  CHECK(box.has("box/c.svg"));
  CHECK_FALSE(box.has("box/pwned"));
  CHECK_FALSE(fs::exists("pwned"));
}

TEST_CASE("a script in the sandbox that runs on is interrupted when its time is over") {
  const Box box;
  const auto code = GENERATE(as<std::string>(), "while true do end", "while true do pcall(function() while true do end end) end",
                             "while true do xpcall(function() while true do end end, function() while true do end end) end",
                             "while true do coroutine.wrap(function() while true do end end)() end",
                             "local x <close> = setmetatable({}, {__close = function() while true do end end})",
                             "print(setmetatable({}, {__tostring = function() while true do end end}))",
                             "setmetatable(_G, {__index = function() while true do end end}) print(x)",
                             "local t = {} while true do t[#t % 1000 + 1] = coroutine.create(function() end) end");
  INFO(code);
  const Outcome o = box(code, {"--seconds", "0.3"});
  CHECK_THAT(o.err, StartsWith("tendril: ") && Contains("s.lua:1: the time limit of 0.3 s is reached\n"));
  CHECK(o.code == out_of_time);
}

TEST_CASE("where no hook of Lua's fires the program ends all the same") {
  const Box box;
  const auto code = GENERATE(as<std::string>(), "print(('a'):rep(40):find(('a*'):rep(40) .. 'b'))", "(''):rep(1e18)",
                             "setmetatable({}, {__gc = function() while true do end end}) collectgarbage()",
                             "x = setmetatable({}, {__gc = function() while true do end end})", "table.move({}, 1, 1e15, 2)");
  INFO(code);
  const Outcome o = box(code, {"--seconds=0.2"});
  CHECK_THAT(o.err, Contains("tendril: the time limit of 0.2 s is reached\n"));
  CHECK(o.code == out_of_time);
}

TEST_CASE("a computation in C++ keeps to the time") {
  const Box box;
  const auto code = GENERATE(as<std::string>(),
                             "while true do s:solve{modes = true} end",
                             "method.variation(s, {outcomes = 100000000, vary = {['a.length'] = {tolerance = 0.01}}, measure = {'a.length'}})",
                             "method.variation(s, {outcomes = 1000000, vary = {['a.length'] = {tolerance = 0.01}}, measure = {x = function() while true do end end}})",
                             "study.accuracy(s, {segments = {62500, 125000, 250000}})");
  INFO(code);
  const Outcome o = box(std::string(hose) + code, {"--seconds", "0.5"});
  CHECK_THAT(o.err, Contains("the time limit of 0.5 s is reached\n") || Contains("not enough memory"));
  CHECK((o.code == out_of_time || o.code == 1));
}

TEST_CASE("a script in the sandbox that asks for too much ends in an error") {
  const Box box;
  const auto code = GENERATE(as<std::string>(), "local s = ('x'):rep(1e9)", "local s = 'x' while true do s = s .. s end",
                             "local t = {} for i = 1, 1e9 do t[i] = {i} end",
                             "local t = {} while true do t[#t + 1] = vec(1, 2, 3) end",
                             "print(hose:with{segments = 2000000000})");
  INFO(code);
  const Outcome o = box(std::string(hose) + code, {"--memory", "128M", "--seconds", "20"});
  CHECK_THAT(o.err, StartsWith("tendril: ") && (Contains("not enough memory") || Contains("'segments'")));
  CHECK(o.code == 1);
}

TEST_CASE("endless recursion and options of every odd kind end in named errors") {
  const Box box;
  const auto [code, words] = GENERATE(table<std::string, std::string>({
      {"local function f() return 1 + f() end f()", "stack overflow"},
      {"local f f = function() return ('x'):gsub('x', f) end f()", "stack overflow"},
      {"local c c = function() return coroutine.wrap(c)() end c()", "C stack overflow"},
      {"assert(load(('('):rep(1e5)))", "overflow"},
      {"string.find(('('):rep(1e5), ('('):rep(1e5))", "too many captures"},
      {"rod.section(setmetatable({}, {__index = function() while true do end end, __pairs = error, __len = function() return 1e18 end}))",
       "missing option 'outer'"},
      {"local t = {} for i = 1, 1e5 do t['k' .. i] = 1 end rod.section(t)", "unknown option"},
      {"local t = {} for i = 1, 1e4 do t = {t} end curve.polyline(t)", "curve.polyline: "},
      {"rod.section{outer = setmetatable({}, {__lt = error, __le = error})}", "option 'outer': got a table"},
  }));
  refuses(box, code, words);
}

TEST_CASE("a script that takes the scene away from under a computation gets its result or an error") {
  const Box box;
  const std::string take = "s:remove('a') s:rod('b' .. math.random(1, 1e9), hose, {}) s:obstacle('o' .. math.random(1, 1e9), scene.sphere{radius = 1}, {}) collectgarbage() ";
  const auto code = GENERATE(as<std::string>(),
                             "method.variation(s, {outcomes = 4, vary = {['a.length'] = {tolerance = 0.01}}, measure = {l = function(e) TAKE return 1 end}})",
                             "method.stability(s, {vary = {['a.length'] = 0.01}, measure = {l = function(e) TAKE return 1 end}})",
                             "s:motion{steps = 5, holds = {['a.finish'] = function(t) TAKE return frame{at = {0.8, 0, 0.1 * t}, along = {1, 0, 0}} end}}",
                             "method.route(s, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.8, 0, 0}, along = {1, 0, 0}},\n"
                             "section = hose.section, min_bend_radius = 0.1, progress = function() TAKE end})",
                             "s:solve{}:gradient(function(e) TAKE return 1 end, {'a.length'})",
                             "local p, eq = s:placed('a'), s:solve{} TAKE print(eq:rod('a').length, eq:clearance{}) p:hold(0.5, frame{at = {0, 0, 0}, along = {1, 0, 0}}, {})");
  INFO(code);
  std::string whole = code;
  whole.replace(whole.find("TAKE"), 4, take);
  const Outcome o = box(std::string(hose) + whole, {"--seconds", "20"});
  CHECK((o.code == 0 || o.code == 1));
  CHECK((o.code == 0 ? o.err.empty() : o.err.find("s.lua:") != o.err.npos));
}

TEST_CASE("what the sandbox leaves") {
  const Box box;
  CHECK(box("print(os.time() > 0, os.clock() >= 0, #os.date() > 0, os.difftime(2, 1))").out == "true\ttrue\ttrue\t1.0\n");
  CHECK(box("collectgarbage() collectgarbage('step') print(collectgarbage('count') > 0, load('return 1 + 1')())").out == "true\t2\n");
  CHECK(box("print(('abc'):upper(), #arg, select('#', ...))").out == "ABC\t0\t0\n");
  CHECK(box("print(#robot.load('builtin:six_axis').links > 6)").out == "true\n");
  CHECK(box(std::string(hose) + "print(s:solve{}.ok)").out == "true\n");
}

TEST_CASE("the sandbox takes a folder, code, and a script on standard input") {
  const Box box;
  const std::string script = box.folder.file("s.lua", "print(pcall(scene.mesh, 'mesh.obj', {unit = 'm'}))");
  CHECK_THAT(run({"--sandbox=" + box.folder.path() + "/box", script}).out, StartsWith("true\t"));
  CHECK_THAT(run({"--sandbox", script}).out, StartsWith("false\t"));
  CHECK(run({"--sandbox=" + box.folder.path(), "-e", "print(io, 1)"}).out == "nil\t1\n");
  CHECK(run({"--sandbox=" + box.folder.path()}, "print(io, 2)").out == "nil\t2\n");
  const Outcome missing = run({"--sandbox=/no/such/folder", script});
  CHECK(missing.code == 2);
  CHECK_THAT(missing.err, StartsWith("tendril: '/no/such/folder' is no folder to confine files to\n"));
}

TEST_CASE("limits hold without the sandbox too, and wrong ones are refused") {
  const Outcome late = run({"--seconds", "0.2", "-e", "while true do end"});
  CHECK(late.code == out_of_time);
  CHECK_THAT(late.err, Contains("the time limit of 0.2 s is reached"));
  CHECK_THAT(run({"--memory", "100M", "-e", "local s = ('x'):rep(2e8)"}).err, Contains("not enough memory"));
  const auto [option, words] = GENERATE(table<std::string, std::string>({{"--memory=1k", "less than the 64M"},
                                                                        {"--memory=lots", "got 'lots', expected a size such as 512M or 8G"},
                                                                        {"--memory=1MB", "got '1MB'"},
                                                                        {"--seconds=0", "got '0', expected seconds, more than 0"},
                                                                        {"--seconds=nan", "got 'nan'"},
                                                                        {"--seconds=1s", "got '1s'"},
                                                                        {"--sandbox=", "needs a folder"},
                                                                        {"--sandbxo", "did you mean '--sandbox'?"}}));
  const Outcome o = run({option, "-e", "print(1)"});
  CHECK(o.code == 2);
  CHECK_THAT(o.err, StartsWith("tendril: ") && Contains(words));
  CHECK_THAT(run({"--sandbox", "-i"}).err, Contains("does not go with -i"));
  CHECK_THAT(run({"--memory"}).err, Contains("'--memory' needs argument"));
}
