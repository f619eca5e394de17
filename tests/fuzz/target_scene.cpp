#include <string>

#include "framework/scene/yaml/reader.h"
#include "tests/fuzz/targets.h"

namespace pintle {

void fuzz_scene(std::string_view bytes) {
  Scene scene;
  try {
    scene = read_scene_text(std::string(bytes), "scene.yaml");
  } catch (const SceneError&) {
    return;
  }
  // What is filled in is a scene again.
  read_scene_text(scene.filled_in, "again.json");
}

}  // namespace pintle
