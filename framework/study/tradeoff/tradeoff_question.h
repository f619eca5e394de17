#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

/// The user's requests that replace those of the file, as written; empty: as in the file.
struct TradeWishes {
  std::vector<std::string> quantities = {};  ///< instead of a study's measures; required for a scene, which has none
  std::string error = {}, time = {}, budget = {};
  int repeats = 0;            ///< 0: as in the file
  std::string dashes = "--";  ///< before the names of options in messages
};

struct TradeQuestion {
  CaseSource scene;
  std::vector<Measure> measures;
  TradePlan plan;
};

/// Reads a study, or a scene with the requested quantities.
/// @throws SceneError  naming file, line, key, value and remedy
TradeQuestion read_trade_question(const std::filesystem::path&, const TradeWishes&, const Overrides& set = {});

/// Runs the settings; lack of memory in one is reported as its reason.
TradeReport run_tradeoff(const TradeQuestion&, const TradeListener& = {});

}  // namespace pintle
