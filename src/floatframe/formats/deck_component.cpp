#include "floatframe/formats/deck_component.hpp"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

#include "floatframe/core/library_path.hpp"

namespace floatframe {
namespace {

DeckComponent load() {
  if (floatframe_deck_component) return *floatframe_deck_component();
  const std::string file = module_path("libfloatframe_decks.so");
  if (file.empty()) return {};
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* component = handle ? ::dlsym(handle, "floatframe_deck_component") : nullptr;
  if (!component) throw std::runtime_error(std::string("decks cannot be read: ") + ::dlerror());
  return *reinterpret_cast<decltype(&floatframe_deck_component)>(component)();
}

}  // namespace

const DeckComponent& deck_component() {
  static const DeckComponent component = load();
  return component;
}

const char* deck_component_missing() {
  return deck_component().readers.empty()
             ? "; decks (.inp, .bdf, .cdb, .unv, ...) need a build with FLOATFRAME_DECKS"
             : "";
}

}  // namespace floatframe
