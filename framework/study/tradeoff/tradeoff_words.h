#pragma once

#include <string>
#include <vector>

#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

/// The answers of a report as sentences, made from its points.
std::vector<std::string> answers_in_words(const TradeReport&);
/// "0.42 %", or "below 0.01 %" where the reference or the ensemble does not resolve more.
std::string error_text(const TradePoint&);
std::string percent_text(double share);
std::string time_text(double seconds);
/// Time and error of a point.
std::string cost_text(const TradeReport&, std::size_t point);
std::string settings_text(std::size_t count);
/// " of the 7 of 84 settings that ran"; empty if all ran.
std::string of_how_many(const TradeReport&);
/// In the form of an option: "4min".
std::string duration_text(double seconds);

/// Why nothing is recommended, and what would help: the reference is not accurate enough …
void say_unknown(const TradeReport&, std::vector<std::string>& said);
/// … or no setting is good enough …
void say_none_meets(const TradeReport&, std::vector<std::string>& said);
/// … or a quantity is the same in every run.
void say_constant(const TradeReport&, std::vector<std::string>& said);

}  // namespace pintle
