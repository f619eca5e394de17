#include "meshes/module.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace pintle {

namespace {

void add_path_of(void* object, std::vector<std::string>& out) {
  Dl_serinfo size;
  if (object == nullptr || dlinfo(object, RTLD_DI_SERINFOSIZE, &size) != 0) return;
  std::vector<std::max_align_t> room(size.dls_size / sizeof(std::max_align_t) + 1);
  auto* info = reinterpret_cast<Dl_serinfo*>(room.data());
  info->dls_size = size.dls_size, info->dls_cnt = size.dls_cnt;
  if (dlinfo(object, RTLD_DI_SERINFO, info) != 0) return;
  for (unsigned i = 0; i < info->dls_cnt; ++i) out.emplace_back(info->dls_serpath[i].dls_name);
}

/// Where the program, and this library if it is shared, look for their libraries, in this order.
std::vector<std::string> search_path() {
  std::vector<std::string> out;
  add_path_of(dlopen(nullptr, RTLD_LAZY), out);
  Dl_info self;
  if (dladdr(reinterpret_cast<const void*>(&load_module), &self) != 0)
    if (void* library = dlopen(self.dli_fname, RTLD_LAZY | RTLD_NOLOAD)) add_path_of(library, out), dlclose(library);
  return out;
}

void* open(const std::string& file, std::string& why) {
  constexpr int how = RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE;
  if (void* found = dlopen(file.c_str(), how)) return found;
  why = dlerror();
  // A sanitizer that replaces dlopen hides the caller, and with it the program's RUNPATH.
  for (const std::string& folder : search_path()) {
    const std::string path = folder + "/" + file;
    if (access(path.c_str(), R_OK) != 0) continue;
    if (void* found = dlopen(path.c_str(), how)) return found;
    why = dlerror();
  }
  return nullptr;
}

}  // namespace

static std::string beside_modules(const std::string& name, int how) {
  static const std::vector<std::string> folders = search_path();
  for (const std::string& folder : folders)
    if (std::string path = folder + "/" + name; access(path.c_str(), how) == 0) return path;
  throw std::runtime_error(name +
                           ": is missing; it is built and installed with pintle: keep it in lib/pintle beside the library, or "
                           "name its folder in LD_LIBRARY_PATH");
}

std::string program_beside_modules(const std::string& name) { return beside_modules(name, X_OK); }
std::string file_beside_modules(const std::string& name) { return beside_modules(name, R_OK); }

const void* load_module(const char* name) {
  const std::string file = "libpintle_" + std::string(name) + ".so", symbol = "pintle_" + std::string(name);
  std::string why;
  void* module = open(file, why);
  if (module == nullptr)
    throw std::runtime_error(file + ": cannot be loaded (" + why +
                             "); it is built and installed with pintle: keep it in lib/pintle beside the library, "
                             "or name its folder in LD_LIBRARY_PATH");
  using Entry = const void* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(module, symbol.c_str()));
  if (entry == nullptr) throw std::runtime_error(file + ": has no " + symbol + "(): not a part of pintle");
  const void* table = entry();
  const char* version = *static_cast<const char* const*>(table);
  if (std::strcmp(version, PINTLE_VERSION) != 0)
    throw std::runtime_error(file + ": is of pintle " + version + ", the program of " + PINTLE_VERSION +
                             "; install both from the same version");
  return table;
}

}  // namespace pintle
