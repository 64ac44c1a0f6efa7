// Scene files: a scene that loads is written, and what is written loads to the same text.
#include "empty_folder.h"
#include "fuzz_target.h"
#include "harness/scene_file.h"

using namespace tendril;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::EmptyFolder::enter();
  LoadedScene loaded;
  if (!fuzz::accepts("scene.load: input.scene.json", [&] { loaded = parse_scene(fuzz::text_of(data, size), "input.scene.json"); })) return 0;
  fuzz::expect(loaded.scene != nullptr, "a file that is read gives a scene");
  const std::string text = scene_text(*loaded.scene, "input.scene.json");
  const LoadedScene again = parse_scene(text, "input.scene.json");
  fuzz::expect(scene_text(*again.scene, "input.scene.json") == text, "a scene that is saved loads as the same scene");
  return 0;
}
