#pragma once

#include <string>
#include <vector>

#include "framework/study/tradeoff.h"

namespace pintle {

/// The answers of a report as sentences, made from its points.
std::vector<std::string> answers_in_words(const TradeReport&);
/// "0.42 %", or "below 0.01 %" where the reference or the ensemble does not tell more.
std::string error_text(const TradePoint&);
std::string percent_text(double share);
std::string time_text(double seconds);
/// As an option takes it: "4min".
std::string duration_text(double seconds);

}  // namespace pintle
