// scene:save, scene.load.
#include "binding/bind_scene_file.h"

#include <cstdio>

#include "binding/examples.h"
#include "harness/scene_file.h"

namespace tendril::lua {

void add_scene_file_to(Class<Scene>& scene) {
  scene.method("save",
               {.takes = {"path"},
                .options = {option<bool>("embed", "", "Meshes stand in the file itself, not by their files' names").preset(false)},
                .does = "Writes all that the scene holds as JSON, for scene.load. Files of meshes and robots are named relative to it where "
                        "they lie near it.",
                .example = with_hose("s:save(\"study.scene.json\")\nprint(scene.load(\"study.scene.json\").rods[1])  --> hose")},
               [](std::shared_ptr<Scene> s, const std::string& path, const Options& o) {
                 save_scene(path, *s, {o.get<bool>("embed")});
                 return s;
               });
}

void add_scene_file_to(Module& scene) {
  scene.function("load",
                 {.takes = {"path"}, .returns = "scene, string[]",
                  .does = "A scene that scene:save wrote: it solves to the same numbers. The second result lists what has changed since, as "
                          "files of meshes; it is also told as a warning.",
                  .example = with_hose("s:save(\"study.scene.json\")\nlocal again, warnings = scene.load(\"study.scene.json\")\n"
                                       "print(#warnings, again:solve{}.residual == s:solve{}.residual)  --> 0\ttrue")},
                 [](lua_State* L, const std::string& path) {
                   LoadedScene loaded = load_scene(path, run_context(L));
                   for (const std::string& warning : loaded.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
                   Value<std::shared_ptr<Scene>>::push(L, loaded.scene);
                   Value<std::vector<std::string>>::push(L, loaded.warnings);
                   return Pushed{2};
                 });
}

}  // namespace tendril::lua
