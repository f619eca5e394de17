#include "framework/study/sweep/part.h"

#include <charconv>

#include <nlohmann/json.hpp>

#include "framework/common/fingerprint.h"
#include "framework/scene/yaml/json_text.h"
#include "framework/study/sweep/sweep.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

/// All except the file's name, which may differ when the part is continued.
Json identity(const PartFile& p) {
  return {{"program", "pintle"},    {"version", p.version},       {"part", p.part.number},      {"of", p.part.count},    {"cases", p.cases},
          {"fingerprint", p.study}, {"study.yaml", p.study_text}, {"scene.yaml", p.scene_text}, {"measures", p.measures}};
}

std::uint64_t print_of(const PartFile& p) { return fingerprint(json_text(identity(p), -1)); }

bool read_number(std::string_view text, std::size_t& out) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, out);
  return error == std::errc() && stop == end;
}

}  // namespace

SweepPart read_part(const std::string& text) {
  const auto slash = text.find('/');
  const std::string_view all = text;
  const auto fail = [&](const std::string& why) -> SweepPart {
    throw SceneError("--shard " + (text.empty() ? "\"\"" : text) + ": " + why);
  };
  SweepPart out;
  if (slash == std::string::npos || !read_number(all.substr(0, slash), out.number) || !read_number(all.substr(slash + 1), out.count))
    return fail("is not a part of a sweep; write its number and how many there are, for example --shard 3/8" +
                std::string(text.empty() || text.starts_with('/') || text.ends_with('/') ? " (is a variable of the script not set?)" : ""));
  if (out.count < 1 || out.count > most_cases)
    return fail("a sweep has from 1 to " + std::to_string(most_cases) + " parts; write for example --shard 3/8");
  const std::string last = std::to_string(out.count) + "/" + std::to_string(out.count);
  if (out.number < 1)
    return fail("parts are numbered from 1; write 1/" + std::to_string(out.count) + " to " + last + " (in a job array: --array=1-" +
                std::to_string(out.count) + ")");
  if (out.number > out.count)
    return fail("there is no part " + std::to_string(out.number) + " of " + std::to_string(out.count) + "; write 1/" +
                std::to_string(out.count) + " to " + last);
  return out;
}

std::string part_text(const SweepPart& part) { return "part " + std::to_string(part.number) + " of " + std::to_string(part.count); }

std::size_t cases_in(const SweepPart& part, std::size_t cases) {
  const std::size_t each = cases / part.count;
  std::size_t out = each;
  for (std::size_t k = each * part.count + 1; k <= cases; ++k) out += part.has(k);
  return out;
}

PartFile part_file(const Sweep& sweep) {
  PartFile out{*sweep.part,
               sweep.cases.size(),
               sweep.study.file,
               PINTLE_VERSION,
               fingerprint_text(sweep.print),
               fingerprint_text(fingerprint(sweep.text)),
               fingerprint_text(fingerprint(sweep.study.scene.text)),
               {},
               0};
  for (const Measure& m : sweep.study.measures) out.measures.push_back(m.name);
  out.print = print_of(out);
  return out;
}

std::string part_json(const PartFile& p) {
  Json out = identity(p);
  out["file"] = p.file;
  return json_text(out) + "\n";
}

PartFile read_part_file(const std::string& path, const std::string& text) {
  const Json j = Json::parse(text, nullptr, false);
  const std::string damaged = path + ": is damaged; run this part again with pintle sweep STUDY --shard I/N, which rewrites it";
  PartFile out;
  try {
    out = {{j.at("part"), j.at("of")},
           j.at("cases"),
           j.at("file"),
           j.at("version"),
           j.at("fingerprint"),
           j.at("study.yaml"),
           j.at("scene.yaml"),
           j.at("measures"),
           0};
  } catch (const Json::exception&) {
    throw SceneError(damaged);
  }
  const auto [number, count] = out.part;
  if (number < 1 || number > count || count > most_cases || out.cases > most_cases) throw SceneError(damaged);
  out.print = print_of(out);
  return out;
}

}  // namespace pintle
