// glTF 2.0 in one binary file (.glb), written by Open Asset Import Library.
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Exporter.hpp>
#include <map>
#include <optional>

#include "cloth/material_look.h"
#include "core/error.h"
#include "export/formats.h"
#include "export/surface_color.h"
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

aiMaterial* makeMaterial(const std::string& name, const RenderSettings* look) {
  auto* material = new aiMaterial;
  const aiString itsName(name);
  material->AddProperty(&itsName, AI_MATKEY_NAME);
  const int twoSided = 1;
  material->AddProperty(&twoSided, 1, AI_MATKEY_TWOSIDED);
  if (look == nullptr) return material;
  const Vec3d color = linearFromSrgb(look->color);
  const aiColor4D base(static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z),
                       1);
  material->AddProperty(&base, 1, AI_MATKEY_BASE_COLOR);
  const auto roughness = static_cast<float>(clothRoughness(*look));
  material->AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  return material;
}

// A node, a mesh and a two-sided material a cloth. A cloth of which no triangle is left would be read as
// loose points and has none.
void fill(aiScene& scene, const State& state, const Cloth& cloth,
          const std::map<std::size_t, Triangles>& ofPieces, const Scene* looksOf) {
  const std::vector<Vec3f> normals = vertexNormals(state, cloth);
  scene.mMaterials = new aiMaterial*[ofPieces.size()];
  scene.mMeshes = new aiMesh*[ofPieces.size()];
  scene.mRootNode = new aiNode("clothsim");
  scene.mRootNode->mChildren = new aiNode*[ofPieces.size()];
  for (const auto& [piece, triangles] : ofPieces) {
    const unsigned number = scene.mNumMeshes++;
    const std::string name = clothName(cloth, piece);
    const std::optional<RenderSettings> look =
        looksOf == nullptr ? std::nullopt : std::optional(lookOf(*looksOf, piece));
    scene.mMaterials[scene.mNumMaterials++] = makeMaterial(name, look ? &*look : nullptr);
    scene.mMeshes[number] = makeMesh(cloth, cloth.pieces()[piece], state, normals, triangles);
    scene.mMeshes[number]->mName = name;
    scene.mMeshes[number]->mMaterialIndex = number;
    aiNode* const node = scene.mRootNode->mChildren[number] = makeNode(name);
    scene.mRootNode->mNumChildren = scene.mNumMeshes;
    node->mParent = scene.mRootNode;
    node->mMeshes[0] = number;
  }
}

void appendWord(std::string& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xFF);
}

std::size_t wordAt(const std::string& bytes, std::size_t place) {
  std::size_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= std::size_t{static_cast<unsigned char>(bytes[place + i])} << 8 * i;
  return word;
}

constexpr std::size_t FILE_HEADER = 12, CHUNK_HEADER = 8;

// A file of a chunk of JSON, padded, and the chunks that follow.
std::string glbOf(std::string json, const std::string& rest) {
  json.append((4 - json.size() % 4) % 4, ' ');
  std::string file = "glTF";
  appendWord(file, 2);
  appendWord(file, FILE_HEADER + CHUNK_HEADER + json.size() + rest.size());
  appendWord(file, json.size());
  return file + "JSON" + json + rest;
}

// The library lists extensions whether they are used or not; these files use none.
std::string withoutExtensions(const std::string& glb) {
  constexpr std::size_t begin = FILE_HEADER + CHUNK_HEADER;
  const std::size_t length = wordAt(glb, FILE_HEADER);
  std::string json = glb.substr(begin, length);
  if (const std::size_t list = json.find("\"extensionsUsed\":["); list != json.npos)
    json.erase(list, json.find_first_not_of(", ", json.find(']', list) + 1) - list);
  return glbOf(json, glb.substr(begin + length));
}

// The library cannot write a scene without a mesh.
constexpr const char* EMPTY_SCENE =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"clothsim"}]})";

}  // namespace

std::string formatGlb(const State& state, const Cloth& cloth, const Scene* looksOf) {
  std::map<std::size_t, Triangles> ofPieces;
  for (const auto& triangle : remainingTriangles(cloth, state.cuts))
    ofPieces[cloth.pieceOf(triangle[0])].push_back(triangle);
  if (ofPieces.empty()) return glbOf(EMPTY_SCENE, "");
  aiScene scene;
  fill(scene, state, cloth, ofPieces, looksOf);
  Assimp::Exporter exporter;
  const aiExportDataBlob* const blob = exporter.ExportToBlob(&scene, "glb2");
  if (blob == nullptr) throw InputOutputError(std::string("cannot write glTF: ") + exporter.GetErrorString());
  return withoutExtensions({static_cast<const char*>(blob->data), blob->size});
}

}  // namespace clothsim
