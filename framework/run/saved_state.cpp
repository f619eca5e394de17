#include "framework/run/saved_state.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <locale>
#include <sstream>

#include <nlohmann/json.hpp>

#include "framework/scene/error.h"

namespace pintle {

namespace {

constexpr const char* first_line = "pintle state 1";

std::uint64_t hash_of(const std::string& text) {  // FNV-1a
  std::uint64_t h = 14695981039346656037U;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return h;
}

std::string hex(std::uint64_t x) {
  std::array<char, 16> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x, 16).ptr;
  return {digits.data(), end};
}
std::string hex(double x) { return hex(std::bit_cast<std::uint64_t>(x)); }

bool read_hex(std::istream& in, std::uint64_t& x) {
  std::string word;
  if (!(in >> word)) return false;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x, 16);
  return error == std::errc() && end == word.data() + word.size();
}
bool read_hex(std::istream& in, double& x) {
  std::uint64_t bits = 0;
  if (!read_hex(in, bits)) return false;
  x = std::bit_cast<double>(bits);
  return true;
}

/// Of all that changes the motion.
std::uint64_t fingerprint(const Scene& scene) {
  nlohmann::json said = nlohmann::json::parse(scene.filled_in, nullptr, false);
  if (!said.is_object()) return 0;  // a scene made in C++
  said.erase("title");
  said.erase("output");
  if (said.contains("run")) said["run"].erase("until");
  return hash_of(said.dump());
}

template <class Books, class F>
bool each_number(Books& s, F f) {  // the same order for writing and reading
  return f(s.t) && f(s.first.kinetic) && f(s.first.gravity) && f(s.first.springs) && f(s.first.contacts) && f(s.first.strain) &&
         f(s.first.lost) && f(s.first.input) && f(s.energy_in_play) && f(s.worst_unexplained);
}

}  // namespace

std::string state_text(const Scene& scene, const SavedState& state) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << first_line << "\nversion " << PINTLE_VERSION << "\nscene " << hex(fingerprint(scene)) << "\nt " << state.t << " s\nbooks";
  each_number(state, [&](double x) {
    out << ' ' << hex(x);
    return true;
  });
  out << "\nmemory " << state.memory.size() << ' ' << hex(hash_of(state.memory)) << '\n' << state.memory;
  return out.str();
}

SavedState read_state(const std::filesystem::path& file, const Scene& scene) {
  const auto refuse = [&](const std::string& why) { return SceneError("--restart " + file.string() + ": " + why); };
  std::ifstream in(file, std::ios::binary);
  in.imbue(std::locale::classic());
  if (!in) throw refuse("cannot be read; name a file states/NNNNN.state of a run");
  std::string line, word, version;
  std::getline(in, line);
  if (line != first_line) throw refuse("is no saved state; its first line must be \"" + std::string(first_line) + "\"");
  in >> word >> version;
  if (version != PINTLE_VERSION) throw refuse("was saved by pintle " + version + ", this is " + PINTLE_VERSION + "; run the scene from its start");
  std::uint64_t of_scene = 0, of_memory = 0;
  SavedState state;
  std::size_t size = 0;
  double shown = 0;
  const bool read = in >> word && read_hex(in, of_scene) && in >> word >> shown >> word >> word &&
                    each_number(state, [&](double& x) { return read_hex(in, x); }) && in >> word >> size && read_hex(in, of_memory);
  in.get();
  state.memory.assign(std::istreambuf_iterator<char>(in), {});
  if (!read || state.memory.size() != size || hash_of(state.memory) != of_memory) throw refuse("is not whole; take another saved state");
  if (of_scene != fingerprint(scene))
    throw refuse("belongs to another scene, or to this one before it was changed (only title, run.until and output may change); "
                 "restore the scene and its --set values, or run it from its start");
  return state;
}

}  // namespace pintle
