#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

/// What is asked for beside the file, as the user writes it; empty: what the file says.
struct TradeWishes {
  std::vector<std::string> quantities = {};  ///< instead of the measures of a study; a scene has none
  std::string error = {}, time = {}, budget = {};
  int repeats = 0;            ///< 0: what the file says
  std::string dashes = "--";  ///< before the names of options in messages
};

struct TradeQuestion {
  CaseSource scene;
  std::vector<Measure> measures;
  TradePlan plan;
};

/// Of a study, or of a scene with the quantities wanted.
/// @throws SceneError  naming file, line, key, value and remedy
TradeQuestion read_trade_question(const std::filesystem::path&, const TradeWishes&, const Overrides& set = {});

/// Runs the settings; lack of memory in one is its reason.
TradeReport run_tradeoff(const TradeQuestion&, const TradeListener& = {});

}  // namespace pintle
