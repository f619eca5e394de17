#include "framework/integration/events/event.h"

#include <utility>

namespace pintle {

namespace {

class SingleEvent final : public EventGroup {
 public:
  explicit SingleEvent(Event event) : event_(std::move(event)) {}
  int order() const override { return event_.order; }
  int size() const override { return 1; }
  std::string name(int) const override { return event_.name; }
  WatchedGuard watch(int) const override { return {.direction = event_.direction, .zero = event_.zero}; }
  Guard guard(int, const State& state) const override { return event_.guard(state); }
  Guard guard(int, const State& state, const Equations&) const override { return event_.guard(state); }
  bool met(int, const Guard& guard) const override { return std::abs(guard.value) <= event_.zero; }
  void start(Step&) override {}
  std::string follow(Step&, std::span<const Guard>, std::span<const Guard>, const DenseOutput&) override { return {}; }
  EventOutcome act(int, Step& step, const Guard&) override { return event_.act(step.to.state); }
  void save(Writer&) const override {}
  void load(Reader&) override {}
  const char* fault() const override { return nullptr; }

 private:
  Event event_;
};

}  // namespace

std::unique_ptr<EventGroup> single_event(Event event) { return std::make_unique<SingleEvent>(std::move(event)); }

}  // namespace pintle
