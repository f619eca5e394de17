#include "framework/analysis/simulate/saved_state.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <locale>
#include <sstream>
#include <utility>

#include "files/files.h"
#include "framework/analysis/simulate/identity.h"
#include "framework/common/sha256.h"
#include "framework/integration/integrator.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

constexpr std::string_view kind = "pintle state ", first_line = "pintle state 3\n", last_word = "\nchecksum ";
constexpr std::size_t last_line = 75;  // of "\nchecksum ", 64 digits and "\n"

std::string hex(double x) {
  std::array<char, 16> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), std::bit_cast<std::uint64_t>(x), 16).ptr;
  return {digits.data(), end};
}

bool read_hex(std::istream& in, double& x) {
  std::string word;
  if (!(in >> word)) return false;
  std::uint64_t bits = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), bits, 16);
  x = std::bit_cast<double>(bits);
  return error == std::errc() && end == word.data() + word.size();
}

template <class State, class F>
bool each_number(State& s, F f) {  // the same order for writing and reading
  auto& [kinetic, gravity, springs, contacts, strain, lost, input] = s.first;
  return f(s.t) && f(kinetic) && f(gravity) && f(springs) && f(contacts) && f(strain) && f(lost) && f(input) && f(s.energy_in_play) &&
         f(s.worst_unexplained);
}

}  // namespace

SavedState beginning(const Model& model, const State& state) {
  Integrator integrator(model.system, model.scheme, state);
  const Energies now = energies(model.system, state, integrator.equations());
  return {state.t, integrator.save(), now, 0, 0};
}

std::string state_text(const std::string& identity, const SavedState& state) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << first_line << "version " << PINTLE_VERSION << "\nof " << identity << "\nt " << state.t << " s\nbooks";
  each_number(state, [&](double x) {
    out << ' ' << hex(x);
    return true;
  });
  out << "\nmemory " << state.memory.size() << '\n';
  std::string text = std::move(out).str();
  text.reserve(text.size() + state.memory.size() + last_line);
  text += state.memory;
  const std::string sum = sha256(text);
  return text.append(last_word).append(sum).append("\n");
}

SavedState state_of(const std::string& text, const std::string& source, const Scene& scene, const Model& model, const Assembly& assembly) {
  const auto reject = [&](const std::string& why) { return SceneError(source + ": " + why); };
  if (!text.starts_with(kind)) throw reject("is not a saved state; name a file states/NNNNN.state of a run");
  if (!text.starts_with(first_line)) throw reject("was saved by another version of pintle; run the scene from its start");
  if (text.size() < first_line.size() + last_line || text.compare(text.size() - last_line, last_word.size(), last_word) != 0)
    throw reject("is incomplete: its last line must be its checksum; take another saved state");
  const std::string said = text.substr(0, text.size() - last_line);
  if (text.substr(text.size() - last_line) != std::string(last_word) + sha256(said) + "\n")
    throw reject("is damaged: its checksum does not match its contents; take another saved state");

  std::istringstream in(said);
  in.imbue(std::locale::classic());
  std::string word, version, of_scene;
  SavedState state;
  std::size_t size = 0;
  std::getline(in, word);
  in >> word >> version;
  if (version != PINTLE_VERSION)
    throw reject("was saved by pintle " + version + ", this is " + PINTLE_VERSION + "; run the scene from its start");
  bool finite = true;
  const bool read = in >> word && std::getline(in >> std::ws, of_scene) && in >> word >> word >> word >> word &&
                    each_number(state,
                                [&](double& x) {
                                  const bool good = read_hex(in, x);
                                  finite = finite && std::isfinite(x);
                                  return good;
                                }) &&
                    in >> word >> size && in.get() == '\n' && size == said.size() - static_cast<std::size_t>(in.tellg());
  if (!read) throw reject("cannot be understood; take another saved state");
  if (!finite || state.t < 0 || state.energy_in_play < 0)
    throw reject(
        "contains numbers that are not finite, or a negative time or energy; take an earlier state, or run the scene from its start");
  if (const std::string why = difference(of_scene, identity(scene, model, assembly)); !why.empty()) throw reject(why);
  state.memory = said.substr(said.size() - size);
  try {
    Integrator trial(model.system, model.scheme, assembly.start);
    trial.load(state.memory);
    if (trial.state().t != state.t) throw std::invalid_argument("its time differs from the one that it names");
  } catch (const std::invalid_argument& why) {
    throw reject(std::string("cannot be continued: ") + why.what() + "; take another saved state, or run the scene from its start");
  }
  return state;
}

SavedState read_state(const std::filesystem::path& file, const Scene& scene, const Model& model, const Assembly& assembly) {
  const std::string source = "--restart " + file.string();
  constexpr std::size_t most_bytes = std::size_t{4} << 30;
  std::string text;
  try {
    text = read_file(file, most_bytes);
  } catch (const FileRejected& rejected) {
    throw SceneError(source + ": " + rejected.what() + "; name a file states/NNNNN.state of a run");
  }
  if (text.empty()) throw SceneError(source + ": is empty; name another file states/NNNNN.state of a run");
  return state_of(text, source, scene, model, assembly);
}

}  // namespace pintle
