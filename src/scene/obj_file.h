// OBJ files as tinyobjloader reads them, found where scenes look for meshes.
#pragma once

#include <tiny_obj_loader.h>

#include <filesystem>
#include <string>
#include <vector>

namespace clothsim {

// Where a scene's mesh lies: at its path, else below the resource root.
[[nodiscard]] std::filesystem::path meshPath(const std::string& file);

struct ObjFile {
  tinyobj::attrib_t attributes;  // colours only where all points have one
  std::vector<tinyobj::shape_t> shapes;
};
// All polygons are split into triangles. `use` tells messages what the file is for. @throws
// SceneError when it cannot be read, or a line of it makes no sense
[[nodiscard]] ObjFile readObjFile(const std::string& file, const std::string& use);

}  // namespace clothsim
