#include "framework/study/measures/measured_expression.h"

#include <algorithm>
#include <array>

#include "framework/common/words.h"
#include "framework/scene/units/expression.h"
#include "framework/scene/units/signal_words.h"

namespace pintle {

namespace {

// Where a time may begin: the longest expression first.
std::vector<std::size_t> ends_of_expression(const std::string& text) {
  std::vector<std::size_t> out{text.size()};
  const std::string low = lower(text);
  for (const char* word :
       {" at ", " after ", " before ", " until ", " up to ", " from ", " between ", " in the ", " over the ", " since ", ", "})
    for (std::size_t at = low.find(word); at != std::string::npos; at = low.find(word, at + 1)) out.push_back(at);
  std::ranges::sort(out, std::greater{});
  return out;
}

bool ends_with_any(const std::string& name, std::initializer_list<const char*> ends) {
  return std::ranges::any_of(ends, [&](const char* end) { return name.ends_with(end); });
}

bool follows_from_motion(const Scene& scene, const Law& law) {
  const auto words = signal_words(scene);
  return std::ranges::all_of(law.signals, [&](const std::string& name) {
    const auto word = words.find(name);
    if (word == words.end() || word->second.what == SignalWord::state) return false;
    if (word->second.what == SignalWord::output)
      return follows_from_motion(scene, scene.outputs[static_cast<std::size_t>(word->second.index)].law);
    return word->second.what != SignalWord::column || ends_with_any(name, {".ax", ".ay", ".alpha"});
  });
}

}  // namespace

std::optional<MeasuredExpression> measured_expression(const std::string& text, const Scene& scene, std::string& why) {
  const SignalNames names = signal_names(signal_words(scene), SignalUse::written);
  for (const std::size_t end : ends_of_expression(text)) {
    const std::string part = text.substr(0, end);
    try {
      MeasuredLaw read = read_measured_law(part, {}, names);
      if (read.law.constant) continue;
      return MeasuredExpression{{part, std::move(read.law), si_unit(read.dimension), {}}, end};
    } catch (const ExpressionError& error) {
      why = error.what();
      for (const SceneParameter& p : scene.parameters)
        if (why.find("\"" + p.name + "\" is neither") != std::string::npos)
          why = "parameters are not allowed in measures: name an output of the scene that equals " + p.name;
    }
  }
  return {};
}

bool looks_like_a_formula(const std::string& text) {
  return text.find_first_of("+*/^(") != std::string::npos || text.find(" - ") != std::string::npos;
}

bool is_signal_alone(const Scene& scene, const std::string& name) {
  const auto words = signal_words(scene);
  const auto found = words.find(name);
  constexpr std::array alone{SignalWord::length,         SignalWord::length_rate, SignalWord::relative_angle,
                             SignalWord::relative_speed, SignalWord::travel,      SignalWord::work_rate};
  return found != words.end() && std::ranges::find(alone, found->second.what) != alone.end();
}

bool is_unknown_signal(const Scene& scene, const std::string& name) { return !signal_words(scene).contains(name); }

bool is_of_motion(const Scene& scene, const Asked& asked) {
  if (asked.expression) return follows_from_motion(scene, asked.expression->law);
  const auto output = std::ranges::find(scene.outputs, asked.owner, &SceneOutput::name);
  return output != scene.outputs.end() && follows_from_motion(scene, output->law);
}

}  // namespace pintle
