#include "framework/scene/yaml/keys.h"

#include <algorithm>

#include "framework/common/nearest.h"

namespace pintle {

namespace {

const KeyTable& table_at(std::string_view path) {
  const std::span<const KeyTable> all = path.starts_with("study") ? study_tables() : key_tables();
  return *std::ranges::find(all, path, &KeyTable::path);
}

std::vector<std::string> names(const KeyTable& table) {
  std::vector<std::string> out;
  for (const Key& key : table.keys) out.push_back(key.name);
  return out;
}

/// Whether no key of a file is known or nearly so: it is another kind of file, and its keys are not shown in messages.
bool is_foreign(std::span<const Node> entries, std::span<const std::string> known) {
  const auto like_known = [&](const Node& entry) {
    return std::ranges::find(known, entry.name()) != known.end() || !nearest(entry.name(), known).empty();
  };
  return !entries.empty() && std::ranges::none_of(entries, like_known);
}

}  // namespace

std::span<const std::string> choices(std::string_view path, std::string_view key) {
  return std::ranges::find(table_at(path).keys, key, &Key::name)->choices;
}

void check_keys(const Node& group, std::string_view path) {
  const KeyTable& table = table_at(path);
  const std::vector<std::string> known = names(table);
  const std::vector<Node> entries = group.entries("keys and values: " + listed(known));
  if (group.place().key.empty() && is_foreign(entries, known))
    group.fail("has none of the keys " + listed(known) + "; is it the right file?");
  for (const Node& entry : entries)
    if (std::ranges::find(known, entry.name()) == known.end())
      entry.fail("unknown key \"" + entry.name() + "\"." +
                 (entry.is_nothing() ? std::string(" ") + hint_about_commas : did_you_mean(entry.name(), known)));
  std::string missing;
  for (const Key& key : table.keys)
    if (key.required && !group.has(key.name)) missing += (missing.empty() ? "" : ", and ") + key.name + ": " + key.example;
  if (!missing.empty()) group.fail("lacks a required key; add for example " + missing);
}

std::string which_key(const Node& group, std::span<const std::string> keys, const std::string& what) {
  std::vector<std::string> found;
  for (const std::string& key : keys)
    if (group.has(key)) found.push_back(key);
  if (found.empty()) group.fail("does not say " + what + "; add " + listed(keys));
  if (found.size() > 1) group.fail("says " + what + " by " + listed(found, "and") + " at once; keep one of them");
  return found.front();
}

std::size_t which_kind(const Node& group, std::span<const KindKeys> kinds) {
  std::vector<std::string> all, found;
  std::size_t which = 0;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    all.push_back(kinds[i].kind);
    if (!group.has(kinds[i].kind)) continue;
    found.push_back(kinds[i].kind);
    which = i;
  }
  if (found.empty()) group.fail("does not say what it is; add one of " + listed(all));
  if (found.size() > 1) group.fail("is " + listed(found, "and") + " at once; keep one of them");
  const KindKeys& kind = kinds[which];
  for (const std::string& key : group.keys()) {
    if (key == kind.kind || std::ranges::find(kind.beside, key) != kind.beside.end()) continue;
    std::vector<std::string> owners;
    for (const KindKeys& other : kinds)
      if (std::ranges::find(other.beside, key) != other.beside.end()) owners.push_back(other.kind);
    group.at(key).fail("does not belong to " + kind.kind + " but to " + listed(owners) + "; leave it out");
  }
  return which;
}

}  // namespace pintle
