// Small files for the tests of import: written into a folder of their own that goes away with it.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace tendril::test {

class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "tendril-test.XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no folder for test files");
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return *this / name;
  }

 private:
  std::filesystem::path path_;
};

template <class T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::uint32_t crc32(const std::string& data) {
  std::uint32_t crc = ~0u;
  for (unsigned char byte : data) {
    crc ^= byte;
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

/// A zip archive of files that are stored without compression.
inline std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string out, directory;
  for (const auto& [name, data] : files) {
    const std::uint32_t offset = static_cast<std::uint32_t>(out.size()), size = static_cast<std::uint32_t>(data.size());
    std::string common;
    for (int half : {20, 0, 0, 0, 0x21}) put(common, static_cast<std::uint16_t>(half));  // version, flags, stored, time, date
    put(common, crc32(data)), put(common, size), put(common, size);
    put(common, static_cast<std::uint16_t>(name.size())), put(common, std::uint16_t{0});
    out += "PK\x03\x04" + common + name + data;
    directory += std::string("PK\x01\x02\x14\x00", 6) + common + std::string(6, '\0') + std::string(4, '\0');
    put(directory, offset);
    directory += name;
  }
  std::string end = std::string("PK\x05\x06\0\0\0\0", 8);
  put(end, static_cast<std::uint16_t>(files.size())), put(end, static_cast<std::uint16_t>(files.size()));
  put(end, static_cast<std::uint32_t>(directory.size())), put(end, static_cast<std::uint32_t>(out.size()));
  put(end, std::uint16_t{0});
  return out + directory + end;
}

/// A tetrahedron with corners at the origin and at 1, 2, 3 along the axes (volume 1), in a node moved by (10, 0, 0)
/// within a node scaled by 2: volume 8, box (20, 0, 0) ... (22, 4, 6).
inline std::string tetrahedron_glb() {
  std::string bin;
  for (float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 3.f}) put(bin, x);
  for (std::uint16_t i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) put(bin, i);
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
      R"("nodes":[{"scale":[2,2,2],"children":[1]},{"translation":[10,0,0],"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":72}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,2,3]},)"
      R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})";
  while (json.size() % 4) json += ' ';
  std::string out = "glTF";
  put(out, std::uint32_t{2}), put(out, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + bin.size()));
  put(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  put(out, static_cast<std::uint32_t>(bin.size()));
  return out + std::string("BIN\0", 4) + bin;
}

/// The same in COLLADA; the file says inches and z up.
inline std::string tetrahedron_dae() {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common>
<accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><scale>2 2 2</scale><node id="m"><translate>10 0 0</translate>
<instance_geometry url="#g"/></node></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

/// The same in 3MF (transform in the build item), without a scale: box (10, 0, 0) ... (11, 2, 3).
inline std::string tetrahedron_3mf() {
  return zip_of({{"[Content_Types].xml",
                  R"(<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>)"},
                 {"_rels/.rels",
                  R"(<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)"},
                 {"3D/3dmodel.model",
                  R"(<?xml version="1.0"?><model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="2" z="0"/><vertex x="0" y="0" z="3"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/></triangles></mesh></object></resources><build><item objectid="1" transform="1 0 0 0 1 0 0 0 1 10 0 0"/></build></model>)"}});
}

}  // namespace tendril::test
