// The module tendril_import.so: glTF, COLLADA, 3MF and X3D by assimp. Nothing else of the project links assimp.

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>

#include <cstring>

#include <Eigen/LU>

#include "geometry/mesh_file.h"

namespace {

using tendril::Mesh;
using tendril::RunContext;
using tendril::Vec3;

// How assimp asks whether to go on. It owns and deletes its handler.
class Progress final : public Assimp::ProgressHandler {
 public:
  explicit Progress(const RunContext& context) : context_(context) {}
  bool Update(float) override { return !context_.stop(); }

 private:
  const RunContext& context_;
};

// A file can name others, such as the buffers of a glTF file: those that may not be read are not there.
class Files final : public Assimp::DefaultIOSystem {
 public:
  explicit Files(bool (*may_read)(const std::string&)) : may_read_(may_read) {}
  bool Exists(const char* path) const override { return may_read_(path) && DefaultIOSystem::Exists(path); }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    const bool reading = mode[0] == 'r' && !std::strchr(mode, '+');
    return reading && may_read_(path) ? DefaultIOSystem::Open(path, mode) : nullptr;
  }

 private:
  bool (*may_read_)(const std::string&);
};

Eigen::Matrix4d matrix(const aiMatrix4x4& m) {
  Eigen::Matrix4d result;
  result << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return result;
}

void add(const aiMesh& part, const Eigen::Matrix4d& place, Mesh& mesh) {
  if (!(part.mPrimitiveTypes & aiPrimitiveType_TRIANGLE)) return;
  const int first = static_cast<int>(mesh.vertices.size());
  // A mirrored part keeps its outside outside.
  const bool mirrored = place.topLeftCorner<3, 3>().determinant() < 0;
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.vertices.push_back(place.topLeftCorner<3, 3>() * Vec3(v.x, v.y, v.z) + place.topRightCorner<3, 1>());
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    const auto corner = [&](int k) { return first + static_cast<int>(face.mIndices[k]); };
    mesh.triangles.push_back({corner(0), corner(mirrored ? 2 : 1), corner(mirrored ? 1 : 2)});
  }
}

// The root of a COLLADA file holds nothing but the unit the file claims, which the caller's word replaces.
Eigen::Matrix4d root_parent(const aiScene& scene, const std::string& path) {
  const bool collada = path.size() > 4 && (path[path.size() - 3] | 0x20) == 'd';  // .dae, the only such suffix here
  return collada ? matrix(scene.mRootNode->mTransformation).inverse() : Eigen::Matrix4d(Eigen::Matrix4d::Identity());
}

// A stack of its own: files can nest their nodes deeper than the program's stack allows.
void add_nodes(const aiScene& scene, const Eigen::Matrix4d& outside, Mesh& mesh) {
  std::vector<std::pair<const aiNode*, Eigen::Matrix4d>> left{{scene.mRootNode, outside}};
  while (!left.empty()) {
    const auto [node, parent] = left.back();
    left.pop_back();
    const Eigen::Matrix4d place = parent * matrix(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) add(*scene.mMeshes[node->mMeshes[i]], place, mesh);
    for (unsigned i = node->mNumChildren; i-- > 0;) left.emplace_back(node->mChildren[i], place);
  }
}

}  // namespace

extern "C" bool tendril_import_mesh(const char* path, bool (*may_read)(const std::string&), const RunContext& context, Mesh& mesh,
                                    std::string& error) try {
  Assimp::Importer importer;
  importer.SetProgressHandler(new Progress(context));
  importer.SetIOHandler(new Files(may_read));
  // Axes are left as they are in the file.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (context.stop()) return true;
  if (!scene || !scene->mRootNode) {
    const std::string why = importer.GetErrorString();
    error = "truncated, damaged or of another kind than its name says (" + (why.empty() ? "no scene in it" : why) + ")";
    return false;
  }
  if (scene->mNumMeshes > 0) add_nodes(*scene, root_parent(*scene, path), mesh);
  return true;
} catch (const std::exception& failure) {
  error = std::string("damaged (") + failure.what() + ")";
  return false;
}

extern "C" const char* tendril_module_about() {
  static const std::string about = "assimp " + std::to_string(aiGetVersionMajor()) + "." + std::to_string(aiGetVersionMinor()) + "." +
                                   std::to_string(aiGetVersionPatch());
  return about.c_str();
}
