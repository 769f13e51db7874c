// Solid pieces from files, as Tessera writes them.
#pragma once

#include <string>

#include "tessera/base/status.h"
#include "tessera/geometry/scene.h"

namespace tessera::view {

// Whether the bytes begin as a binary glTF does, or are JSON with an `asset`.
bool looks_like_gltf(const std::string& bytes);

// The scene in a GLB, or in a glTF that holds its buffer: what write_glb() and write_gltf() write, quantized or not,
// of one primitive of triangles a mesh and nodes that do not hang on one another. Tangents, extras and lists that
// meshes share are not kept. kInvalidInput where the file is of another kind, damaged, or holds what such files do
// not.
Result<Scene> read_gltf(const std::string& bytes);

}  // namespace tessera::view
