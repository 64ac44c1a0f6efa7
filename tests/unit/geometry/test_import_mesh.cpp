#include <catch2/catch.hpp>
#include <chrono>

#include "base/error.h"
#include "base/write_file.h"
#include "geometry/import_mesh.h"
#include "geometry/mesh_export.h"
#include "geometry/mesh_file.h"
#include "geometry/mesh_topology.h"
#include "unit/geometry/mesh_files.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using Catch::Contains;
using Catch::EndsWith;
using tendril::test::box_mesh;
using tendril::test::Folder;
using tendril::test::Random;

namespace {

void check_box(const LoadedMesh& loaded, const Vec3& low, const Vec3& high, double volume) {
  CHECK(loaded.status == Status::solved);
  CHECK(loaded.mesh.box().min().isApprox(low, 1e-6));
  CHECK(loaded.mesh.box().max().isApprox(high, 1e-6));
  CHECK(loaded.mesh.volume() == Approx(volume).epsilon(1e-5));
  CHECK(topology_of(loaded.mesh, 0).watertight());
}

}  // namespace

TEST_CASE("what is written is read back, in every format and unit", "[import]") {
  const Folder folder;
  Random random(17);
  const Mesh mesh = box_mesh({0.3, 0.4, 0.5}, 3).moved({1, 2, 3}, random.rotation());
  for (const char* name : {"a.stl", "b.ply", "c.obj", "D.STL"})
    for (double unit : {1.0, 1e-3}) {
      CAPTURE(name, unit);
      save_mesh(folder / name, mesh, unit);
      const LoadedMesh loaded = load_mesh(folder / name, unit);
      CHECK(loaded.triangles_in_file == 108);
      CHECK(loaded.mesh.triangles.size() == 108);
      CHECK(loaded.mesh.vertices.size() == 56);  // welded
      CHECK(loaded.warning.empty());
      CHECK(loaded.mesh.name == folder / name);
      check_box(loaded, mesh.box().min(), mesh.box().max(), 0.48);
      if (name[0] != 'a' && name[0] != 'D') CHECK((loaded.mesh.box().max() - mesh.box().max()).norm() < 1e-14);
    }
}

TEST_CASE("binary glTF is written with y up, normals and bounds", "[import]") {
  const Folder folder;
  Random random(18);
  const Mesh mesh = welded(box_mesh({0.3, 0.4, 0.5}, 3).moved({1, 2, 3}, random.rotation()), 1e-9).mesh;
  save_mesh(folder / "new/a.GLB", mesh);
  const LoadedMesh loaded = load_mesh(folder / "new/a.GLB", 1);
  CHECK(loaded.triangles_in_file == 108);
  CHECK(loaded.mesh.vertices.size() == 56);
  Mesh back = loaded.mesh;
  for (Vec3& v : back.vertices) v = Vec3(v.x(), -v.z(), v.y());
  CHECK((back.box().min() - mesh.box().min()).norm() < 1e-6);
  CHECK((back.box().max() - mesh.box().max()).norm() < 1e-6);
  CHECK(back.volume() == Approx(0.48));  // turned, not mirrored
  // The layout that other readers rely on: chunks in whole words, sizes that add up.
  const std::string bytes = glb_of(mesh);
  const auto word = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, &bytes[at], 4);
    return value;
  };
  CHECK(bytes.substr(0, 4) == "glTF");
  CHECK(word(4) == 2);
  CHECK(word(8) == bytes.size());
  CHECK(word(12) % 4 == 0);
  CHECK(bytes.substr(16, 4) == "JSON");
  const std::size_t data = 20 + word(12);
  CHECK(word(data) == 24 * 56 + 12 * 108);
  CHECK(bytes.substr(data + 4, 4) == std::string("BIN\0", 4));
  CHECK(data + 8 + word(data) == bytes.size());
  for (int v = 0; v < 56; ++v) {
    float n[3], p[3];
    std::memcpy(p, &bytes[data + 8 + 12 * v], sizeof p);
    std::memcpy(n, &bytes[data + 8 + 12 * (56 + v)], sizeof n);
    CHECK(Eigen::Vector3f(n[0], n[1], n[2]).norm() == Approx(1));
    const Vec3 out = Vec3(p[0], -p[2], p[1]) - mesh.box().center();
    CHECK(Vec3(n[0], -n[2], n[1]).dot(out) > 0);
  }
  // A vertex without a triangle has a normal too.
  Mesh loose = mesh;
  loose.vertices.push_back({9, 9, 9});
  CHECK(glb_of(loose).find("nan") == std::string::npos);
  CHECK(load_mesh(folder.write("loose.glb", glb_of(loose)), 1).mesh.triangles.size() == 108);
}

TEST_CASE("files are written only when the mesh, the unit and the name make sense", "[import]") {
  const Folder folder;
  const Mesh mesh = box_mesh({1, 1, 1});
  CHECK_THROWS_WITH(save_mesh(folder / "a.step", mesh), EndsWith("files of the suffix '.step' are not written; what is written: .stl, .ply, .obj, .glb"));
  CHECK_THROWS_WITH(save_mesh(folder / "a.glb", mesh, 1e-3), EndsWith("glTF files are in metres; leave the unit out"));
  CHECK_THROWS_WITH(save_mesh(folder / "a.stl", mesh, 0), EndsWith("the unit must be a finite number of metres above 0"));
  CHECK_THROWS_AS(save_mesh(folder / "a.stl", Mesh{}), UsageError);
  CHECK_THROWS_WITH(load_mesh(folder / "a.stl", 1), EndsWith("a.stl': there is no such file"));
  save_mesh(folder / "new/folder/a.stl", mesh);
  CHECK(load_mesh(folder / "new/folder/a.stl", 1).mesh.triangles.size() == 12);
}

TEST_CASE("glTF, COLLADA and 3MF with their scene graphs; the unit is the caller's", "[import]") {
  const Folder folder;
  check_box(load_mesh(folder.write("t.glb", test::tetrahedron_glb()), 1), {20, 0, 0}, {22, 4, 6}, 8);
  check_box(load_mesh(folder.write("t.glb", test::tetrahedron_glb()), 0.01), {0.20, 0, 0}, {0.22, 0.04, 0.06}, 8e-6);
  check_box(load_mesh(folder.write("t.dae", test::tetrahedron_dae()), 1), {20, 0, 0}, {22, 4, 6}, 8);
  check_box(load_mesh(folder.write("t.3mf", test::tetrahedron_3mf()), 1), {10, 0, 0}, {11, 2, 3}, 1);
}

TEST_CASE("OBJ: polygons, negative numbers, textures, continued lines, what is skipped", "[import]") {
  const std::string text =
      "# a comment\nmtllib x.mtl\no thing\r\nv 0 0 0 1.0\nv +1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
      "usemtl none\ns off\nf 1/1/1 2/1/1 3//1 \\\n 4\nf -4 -3 -2\np 1\nl 1 2 3\nv 0 0 1e0\nf 1 5 2";
  const Mesh mesh = parse_obj(text, "x.obj");
  CHECK(mesh.vertices.size() == 5);
  REQUIRE(mesh.triangles.size() == 4);
  CHECK(mesh.triangles[2] == std::array<int, 3>{0, 1, 2});
  CHECK(mesh.triangles[3] == std::array<int, 3>{0, 4, 1});
  CHECK(mesh.vertices[1] == Vec3(1, 0, 0));
  CHECK(mesh.area() == Approx(1 + 0.5 + 0.5));
}

TEST_CASE("hollow polygons are cut along their own sides", "[import]") {
  // An L, a star, and an L out of plane, each from every first corner and both ways round: the area is the polygon's.
  const std::vector<Vec3> ell = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  std::vector<Vec3> star;
  for (int i = 0; i < 10; ++i) star.push_back((i % 2 ? 0.4 : 1.0) * Vec3(std::cos(0.2 * M_PI * i), std::sin(0.2 * M_PI * i), 0));
  const double star_area = 10 * 0.5 * 0.4 * std::sin(0.2 * M_PI);
  Random random(3);
  const Quat turn = random.rotation();
  for (const auto& [shape, area] : {std::pair{ell, 3.0}, std::pair{star, star_area}})
    for (std::size_t first = 0; first < shape.size(); ++first)
      for (bool reversed : {false, true}) {
        Mesh mesh;
        for (const Vec3& p : shape) mesh.vertices.push_back(turn * p + Vec3(5, 6, 7));
        std::vector<int> corners;
        for (std::size_t i = 0; i < shape.size(); ++i)
          corners.push_back(static_cast<int>((first + (reversed ? shape.size() - i : i)) % shape.size()));
        triangulate(mesh.vertices, corners, mesh.triangles);
        CHECK(mesh.triangles.size() == shape.size() - 2);
        CHECK(mesh.area() == Approx(area));
        CHECK(topology_of(mesh, 0).non_manifold_edges == 0);
      }
  std::vector<std::array<int, 3>> flat;
  triangulate({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {0, 1, 2, 3}, flat);  // no area at all
  CHECK(flat.size() == 2);
}

TEST_CASE("STL: text and binary, also a binary one that opens with 'solid'", "[import]") {
  const std::string facet = "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1e0 0\n endloop\nendfacet\n";
  CHECK(parse_stl("solid a b c\n" + facet + facet + "endsolid a\nsolid d\n" + facet + "endsolid d\n", "a.stl").area() == Approx(1.5));
  std::string binary = stl_of(box_mesh({1, 1, 1}));
  binary.replace(0, 5, "solid");
  CHECK(parse_stl(binary, "b.stl").volume() == Approx(8));
  CHECK_THROWS_WITH(parse_stl("solid a\n" + facet, "a.stl"), "mesh 'a.stl': truncated: no 'endsolid' at its end");
  CHECK_THROWS_WITH(parse_stl("solid a\n" + facet.substr(0, 45), "a.stl"), Contains("truncated"));
  CHECK_THROWS_WITH(parse_stl("solid a\n vertex 1 2", "a.stl"), "mesh 'a.stl': line 2: a vertex without three numbers; is the file truncated?");
  CHECK_THROWS_WITH(parse_stl("solid a\nouter loop\nvertex 0 0 0\nvertex 1 1 1\nendloop\n", "a.stl"),
                    "mesh 'a.stl': line 5: a facet without three vertices");
  CHECK_THROWS_WITH(parse_stl(binary.substr(0, binary.size() - 7), "b.stl"), Contains("truncated"));
  CHECK_THROWS_WITH(parse_stl(stl_of(box_mesh({1, 1, 1})).substr(0, 300), "b.stl"),
                    "mesh 'b.stl': truncated or not an STL file: 12 triangles take 684 bytes, the file has 300");
  CHECK_THROWS_WITH(parse_stl(stl_of(box_mesh({1, 1, 1})) + "xyz", "b.stl"),
                    "mesh 'b.stl': not an STL file, or damaged: 12 triangles take 684 bytes, the file has 687");
  CHECK_THROWS_WITH(parse_stl("short", "b.stl"), "mesh 'b.stl': truncated or not an STL file: shorter than the header of one");
}

TEST_CASE("PLY: text, both byte orders, other elements and properties", "[import]") {
  const std::string header =
      "ply\nformat ascii 1.0\ncomment c\nelement material 1\nproperty list uchar float params\nproperty uchar n\n"
      "element vertex 4\nproperty float z\nproperty uchar red\nproperty double x\nproperty float y\n"
      "element face 1\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";
  const Mesh text = parse_ply(header + "2 0.5 0.5 7\n0 255 0 0\n0 255 1 0\n0 255 1 1 0 255 0 1\n9 4 0 1 2 3\n", "a.ply");
  CHECK(text.area() == Approx(1));
  CHECK(text.vertices[2] == Vec3(1, 1, 0));

  const auto big = [](auto value) {
    std::string bytes;
    test::put(bytes, value);
    return std::string(bytes.rbegin(), bytes.rend());
  };
  std::string binary = header;
  binary.replace(binary.find("ascii"), 5, "binary_big_endian");
  binary += std::string("\2") + big(0.5f) + big(0.5f) + "\7";
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
    binary += big(static_cast<float>(p.z())) + "\xff" + big(p.x()) + big(static_cast<float>(p.y()));
  binary += std::string("\x09\x04") + big(0) + big(1) + big(2) + big(3);
  CHECK(parse_ply(binary, "a.ply").area() == Approx(1));

  CHECK_THROWS_WITH(parse_ply(binary.substr(0, binary.size() - 3), "a.ply"), "mesh 'a.ply': truncated: it ends in face 1 of 1");
  CHECK_THROWS_WITH(parse_ply(header.substr(0, header.find("element vertex")), "a.ply"), "mesh 'a.ply': truncated: its header does not end");
  CHECK_THROWS_WITH(parse_ply(header + "2 0.5 0.5 7\n0 255 0 0\n0 255", "a.ply"), "mesh 'a.ply': truncated: it ends in vertex 2 of 4");
  CHECK_THROWS_WITH(parse_ply(header + "2 0.5 0.5 7\n0 255 0 zero", "a.ply"), "mesh 'a.ply': vertex 1 holds 'zero' where a number is expected");
  CHECK_THROWS_WITH(parse_ply(header + "0 7\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 9 3 0 1 4", "a.ply"),
                    "mesh 'a.ply': a face uses vertex 5; there are 4 vertices");
  CHECK_THROWS_WITH(parse_ply(header + "0 7\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 9 2 0 1", "a.ply"),
                    "mesh 'a.ply': face 1 has 2 corners; 3 to 1000 are read");
  CHECK_THROWS_WITH(parse_ply("plx", "a.ply"), "mesh 'a.ply': not a PLY file: it does not begin with 'ply'");
  CHECK_THROWS_WITH(parse_ply("ply\nformat utf8 1.0\n", "a.ply"), "mesh 'a.ply': line 2: unknown format 'utf8'");
  CHECK_THROWS_WITH(parse_ply("ply\nformat ascii 1.0\nelement vertex 99999999999\n", "a.ply"), Contains("truncated"));
  CHECK_THROWS_WITH(parse_ply("ply\nproperty float x\n", "a.ply"), "mesh 'a.ply': line 2: a property before any element");
  CHECK_THROWS_WITH(parse_ply("ply\nelement vertex 3\nproperty quad x\n", "a.ply"), "mesh 'a.ply': line 3: unknown type 'quad'");
  CHECK_THROWS_WITH(parse_ply("ply\nnonsense\n", "a.ply"), "mesh 'a.ply': line 2: 'nonsense' is no part of a PLY header");
}

TEST_CASE("broken files say what is wrong with them", "[import]") {
  const Folder folder;
  const auto says = [&](const std::string& name, const std::string& content, const std::string& what) {
    CAPTURE(name, content.substr(0, 60));
    CHECK_THROWS_WITH(load_mesh(folder.write(name, content), 1), Contains("mesh '" + folder / name + "'") && Contains(what));
  };
  CHECK_THROWS_WITH(load_mesh(folder / "", 1), EndsWith("it is a folder, not a file"));
  CHECK_THROWS_WITH(load_mesh("", 1), "mesh '': no file name was given");
  CHECK_THROWS_WITH(load_mesh("/dev/null", 1), "mesh '/dev/null': it is not a regular file");
  says("bay.step", "ISO-10303-21", "files of the suffix '.step' are not read; what is read: .obj, .stl, .ply, .gltf, .glb, .dae, .3mf, .wrl, .vrml, .x3d");
  says("bay", "x", "a name without a suffix; what is read: .obj");
  for (const std::string& suffix : mesh_suffixes()) {
    says("empty" + suffix, "", "the file is empty");
    says("blank" + suffix, " \n\r\n", "the file is empty");
    says("picture" + suffix, "\x89PNG\r\n\x1a\n and more", "it begins like a PNG picture file");
  }
  says("a.obj", "ply\nformat ascii 1.0\n", "of another kind than its name says: it begins like a .ply file");
  says("a.ply", test::tetrahedron_glb(), "it begins like a .glb file");
  says("a.obj", std::string("v 0 0 0\n\0\0\0", 11), "it holds binary data");
  says("a.glb", "plain text", "truncated or not a .glb file");
  says("a.glb", test::tetrahedron_glb().substr(0, 400), "truncated: 400 of");
  says("a.dae", test::tetrahedron_dae().substr(0, 700), "truncated, damaged or of another kind");
  says("a.3mf", test::tetrahedron_3mf().substr(0, 1200), "truncated, damaged or of another kind");
  says("a.gltf", "{\"asset\":{\"version\":\"2.0\"}", "truncated, damaged or of another kind");
  says("a.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"empty"}]})", "");
  says("a.obj", "once upon a time\n", "not an OBJ file: line 1 begins with 'once'");
  says("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no triangles");
  says("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", "no triangles");
  says("a.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", "vertex 2 is (");
  says("a.obj", "v 0 0 0\nv 1 0 1e999\nv 0 1 0\nf 1 2 3\n", "finite numbers within 1e+09 m expected");
  says("a.obj", "v 0 0 0\nv 1 0\n", "line 2: a vertex without three numbers");
  says("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "line 4: a face of 2 corners");
  says("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: a face uses vertex 4, but the file has 3 vertices");
  says("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n", "line 4: a face uses vertex 4, but only 3 come before it");
  says("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "line 4: a face counts back beyond the first vertex");
  says("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf a b c\n", "line 4: a face whose corners are not vertex numbers");
  says("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\n", "all of its triangles are degenerate");
  std::string nan = stl_of(box_mesh({1, 1, 1}));
  const float not_a_number = std::nanf("");
  std::memcpy(nan.data() + 84 + 12 + 4, &not_a_number, 4);
  says("a.stl", nan, "vertex 1 is (");
  says("a.stl", std::string(84, '\0'), "no triangles");
  const std::string obj = folder.write("good.obj", obj_of(box_mesh({1, 1, 1})));
  for (double unit : {0.0, -1.0, std::nan("")})
    CHECK_THROWS_WITH(load_mesh(obj, unit), Contains("the metres in one unit of the file expected, such as 0.001 for mm"));
}

TEST_CASE("no truncation of a good file crashes or hangs", "[import]") {
  const Folder folder;
  const Mesh mesh = box_mesh({1, 1, 1});
  const std::vector<std::pair<std::string, std::string>> files = {{"a.obj", obj_of(mesh)}, {"a.stl", stl_of(mesh)},
                                                                  {"a.ply", ply_of(mesh)}, {"a.glb", test::tetrahedron_glb()}};
  for (const auto& [name, content] : files) {
    int good = 0;
    for (std::size_t size = 0; size < content.size(); size += name == "a.glb" ? 37 : 3) {
      try {
        good += load_mesh(folder.write(name, content.substr(0, size)), 1).mesh.triangles.size() == 12;
      } catch (const UsageError&) {
      }
    }
    // An OBJ cut within its last number or right before its last line break is whole.
    CHECK(good <= (name == "a.obj" ? 2 : 0));
  }
}

TEST_CASE("an unlikely size is warned about, with the likely unit", "[import]") {
  CHECK(unlikely_size(4.2, 1).empty());
  CHECK(unlikely_size(4200, 1) == "it is 4.2e+03 m across, which is unlikely; if the file's unit is mm, it is 4.2 m");
  CHECK(unlikely_size(0.0008, 1e-3) == "it is 0.0008 m across, which is unlikely; if the file's unit is m, it is 0.8 m");
  CHECK(unlikely_size(1e-9, 1) == "it is 1e-09 m across, which is unlikely");
  const Folder folder;
  const LoadedMesh loaded = load_mesh(folder.write("car.obj", obj_of(box_mesh({2100, 900, 700}))), 1);
  CHECK_THAT(loaded.warning, EndsWith("car.obj': it is 4.78e+03 m across, which is unlikely; if the file's unit is mm, it is 4.78 m"));
}

TEST_CASE("degenerate and repeated triangles of a file are dropped and counted", "[import]") {
  const Folder folder;
  const LoadedMesh loaded = load_mesh(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 4 2 3\nf 1 4 2\n"), 1);
  CHECK(loaded.triangles_in_file == 3);
  CHECK(loaded.repeated_triangles == 1);
  CHECK(loaded.degenerate_triangles == 1);
  CHECK(loaded.mesh.triangles.size() == 1);
  CHECK(loaded.mesh.vertices.size() == 3);
}

TEST_CASE("loading stops when told to", "[import]") {
  const Folder folder;
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  for (const std::string& path : {folder.write("a.obj", obj_of(box_mesh({1, 1, 1}))), folder.write("a.glb", test::tetrahedron_glb())}) {
    CHECK(load_mesh(path, 1, context).status == Status::cancelled);
    CHECK(load_mesh(path, 1, context).mesh.triangles.empty());
  }
  RunContext late;
  late.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  CHECK(load_mesh(folder / "a.obj", 1, late).status == Status::timeout);
}
