#include "framework/study/measures/mode_measure.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/bodies/elastic_body.h"
#include "framework/common/nearest.h"
#include "framework/common/words.h"
#include "framework/scene/error.h"
#include "framework/study/measures/measure_vocabulary.h"

namespace pintle {

namespace {

using ModePart = AskedMode::Part;
constexpr double no_mode = std::numeric_limits<double>::quiet_NaN();

struct PartWord {
  const char* words;
  ModePart part;
  const char* unit;
};
/// Longer ones first where one begins like another.
constexpr std::array part_words{PartWord{"natural frequency", ModePart::natural, "Hz"},
                                PartWord{"undamped frequency", ModePart::natural, "Hz"},
                                PartWord{"damped frequency", ModePart::frequency, "Hz"},
                                PartWord{"frequency", ModePart::frequency, "Hz"},
                                PartWord{"damping ratio", ModePart::damping, ""},
                                PartWord{"damping", ModePart::damping, ""},
                                PartWord{"decay rate", ModePart::decay, "1/s"},
                                PartWord{"decay", ModePart::decay, "1/s"},
                                PartWord{"real part", ModePart::real, "1/s"},
                                PartWord{"imaginary part", ModePart::imaginary, "rad/s"}};

[[noreturn]] void fail_words(const Measure& m, const Scene& scene, const std::string& message) {
  Place place = m.place;
  if (place.key.empty()) place.key = "measure \"" + m.words + "\"";
  throw SceneError(m.file.empty() ? scene.file : m.file, place, message);
}

int mode_number(Words& words) {
  const std::string digits = words.rest().substr(0, words.rest().find(' '));
  int n = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
  return error == std::errc() && end == digits.data() + digits.size() && n > 0 && words.take(digits) ? n : 0;
}

}  // namespace

AskedMode read_mode_measure(const Measure& m, const Scene& scene) {
  const bool of_body = m.question.analysis == Analysis::modes;
  const std::string remedy = of_body ? "write for example frequency of mode 1 of BODY or damping of mode 2 of BODY"
                                     : "write for example frequency of mode 1, natural frequency of mode 1, damping of root 2 or "
                                       "decay of mode 1";
  AskedMode out;
  Words words(m.words);
  words.skip_articles();
  bool known = false;
  for (const PartWord& p : part_words)
    if (!known && words.take(p.words)) out.part = p.part, out.unit = p.unit, known = true;
  words.take_any({"of", "at"});
  words.skip_articles();
  known = known && !words.take_any({"mode", "root"}).empty() && (out.number = mode_number(words)) > 0;
  if (known && of_body) {
    words.take_any({"of", "in"});
    out.body = words.rest();
    elastic_of(scene, out.body);  // reports the existing bodies
  } else if (known && !words.done()) {
    known = false;
  }
  if (!known) {
    Names parts;
    for (const PartWord& p : part_words) parts.emplace_back(p.words);
    const std::string meant = with_nearest_beginning(m.words, parts);
    fail_words(m, scene,
               "\"" + m.words + "\" is not a result of " + (of_body ? "modes" : "linearize") +
                   (meant.empty() ? "; " + remedy : ". Did you mean \"" + meant + "\"?"));
  }
  if (of_body && out.part != ModePart::frequency && out.part != ModePart::natural && out.part != ModePart::damping)
    fail_words(m, scene, "the modes of one body have only a frequency and a damping ratio; " + remedy);
  return out;
}

double value_of(const AskedMode& asked, const Linearization& lin) {
  if (asked.number > static_cast<int>(lin.modes.size())) return no_mode;
  const LinearMode& mode = lin.modes[static_cast<std::size_t>(asked.number - 1)];
  const double real = std::abs(mode.root.real()) <= mode.uncertainty ? 0 : mode.root.real();  // values within rounding count as zero
  switch (asked.part) {
    case ModePart::frequency: return mode.frequency();
    case ModePart::natural: return mode.natural();
    case ModePart::damping: return real == 0 ? 0 : mode.damping();
    case ModePart::decay: return -real;
    case ModePart::real: return real;
    case ModePart::imaginary: return mode.root.imag();
  }
  return no_mode;
}

double value_of(const AskedMode& asked, const ModesReport& report) {
  const Eigen::Index k = asked.number - 1;
  if (asked.part == ModePart::damping) return k < report.natural.zeta.size() ? report.natural.zeta[k] : no_mode;
  const Eigen::VectorXd& omega = report.natural.modes.omega;
  return k < omega.size() ? omega[k] / (2 * std::numbers::pi) : no_mode;
}

}  // namespace pintle
