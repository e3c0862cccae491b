// glTF 2.0 in one binary file (.glb), written by Open Asset Import Library.
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Exporter.hpp>
#include <map>

#include "core/error.h"
#include "export/formats.h"
#include "export/texture_points.h"

namespace clothsim {
namespace {

// The points of a piece and its triangles; at a seam of the texture a point is there once for each of its
// coordinates. The library frees what a scene holds.
aiMesh* makeMesh(const Cloth& cloth, const Piece& piece, const State& state,
                 const std::vector<Vec3f>& normals,
                 const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const TexturePoints texture(cloth, piece);
  auto* mesh = new aiMesh;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = static_cast<unsigned>(texture.points().size());
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  mesh->mNormals = new aiVector3D[mesh->mNumVertices];
  mesh->mTextureCoords[0] = new aiVector3D[mesh->mNumVertices];
  mesh->mNumUVComponents[0] = 2;
  for (std::uint32_t i = 0; i < mesh->mNumVertices; ++i) {
    const auto& [particle, uv] = texture.points()[i];
    const Particle4& x = state.positions[particle];
    const Vec3f& n = normals[particle];
    mesh->mVertices[i] = {x.x, x.y, x.z};
    mesh->mNormals[i] = {n.x, n.y, n.z};
    mesh->mTextureCoords[0][i] = {uv[0], uv[1], 0};
  }
  mesh->mNumFaces = static_cast<unsigned>(triangles.size());
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    mesh->mFaces[t].mNumIndices = 3;
    mesh->mFaces[t].mIndices = new unsigned[3];
    std::ranges::copy(texture.of(triangles[t]), mesh->mFaces[t].mIndices);
  }
  return mesh;
}

aiNode* makeNode(const std::string& name) {
  auto* node = new aiNode(name);
  node->mNumMeshes = 1;
  node->mMeshes = new unsigned[1];
  return node;
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// A node and a mesh a cloth, in one two-sided material. A cloth of which no triangle is left would be read as
// loose points and has none.
void fill(aiScene& scene, const State& state, const Cloth& cloth) {
  const std::vector<Vec3f> normals = vertexNormals(state, cloth);
  std::map<std::size_t, Triangles> ofPieces;
  for (const auto& triangle : remainingTriangles(cloth, state.cuts))
    ofPieces[cloth.pieceOf(triangle[0])].push_back(triangle);
  if (ofPieces.empty()) throw InputOutputError("cannot write glTF: no triangle of the cloth is left");
  scene.mNumMaterials = 1;
  scene.mMaterials = new aiMaterial* [1] { new aiMaterial };
  const int twoSided = 1;
  scene.mMaterials[0]->AddProperty(&twoSided, 1, AI_MATKEY_TWOSIDED);
  scene.mMeshes = new aiMesh*[ofPieces.size()];
  scene.mRootNode = new aiNode("clothsim");
  scene.mRootNode->mChildren = new aiNode*[ofPieces.size()];
  for (const auto& [piece, triangles] : ofPieces) {
    const unsigned number = scene.mNumMeshes++;
    const std::string name = clothName(cloth, piece);
    scene.mMeshes[number] = makeMesh(cloth, cloth.pieces()[piece], state, normals, triangles);
    scene.mMeshes[number]->mName = name;
    aiNode* const node = scene.mRootNode->mChildren[number] = makeNode(name);
    scene.mRootNode->mNumChildren = scene.mNumMeshes;
    node->mParent = scene.mRootNode;
    node->mMeshes[0] = number;
  }
}

}  // namespace

std::string formatGlb(const State& state, const Cloth& cloth) {
  aiScene scene;
  fill(scene, state, cloth);
  Assimp::Exporter exporter;
  const aiExportDataBlob* const blob = exporter.ExportToBlob(&scene, "glb2");
  if (blob == nullptr) throw InputOutputError(std::string("cannot write glTF: ") + exporter.GetErrorString());
  return {static_cast<const char*>(blob->data), blob->size};
}

}  // namespace clothsim
