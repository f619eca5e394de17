#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/build/markers.h"
#include "framework/mechanism/model.h"
#include "framework/scene/units/signal_words.h"

namespace pintle {

/// Creates signals and laws of a system from those of the scene. Signals have their own markers, which must not affect the size of the
/// mechanism: a law is `begun` where the scene defines it, and `finished` when that size is known.
class SignalMaker {
 public:
  SignalMaker(const Scene& scene, Markers& markers, Model& model) : scene_(scene), markers_(markers), model_(model) {}

  /// Its index in System::laws; also for a law of time.
  int begin(const Law&, const Place&);
  void finish();
  /// A law that is not part of the system, of an output or an event. After finish. @throws SceneError  an unknown signal
  SignalLaw law(const Law&, const Place&);
  int signal(const std::string& name, const Place&);  ///< its index in System::signals
  const std::map<std::string, SignalWord, std::less<>>& words();

 private:
  MotionSignal made(const SignalWord&);
  int frame(const PointRef& body);
  void warn_of_swing(const Law&, const Place&);
  int add(const Marker&);
  [[noreturn]] void wrong(const Place&, const std::string& message) const;

  const Scene& scene_;
  Markers& markers_;
  Model& model_;
  std::optional<std::map<std::string, SignalWord, std::less<>>> words_;
  std::map<std::string, int, std::less<>> known_;
  struct Begun {
    std::size_t law;
    const Law* from;
    Place place;
  };
  std::vector<Begun> begun_;
};

/// An output whose inputs are signals, columns of the trajectory and earlier outputs.
WrittenOutput written_output(const Scene&, const SceneOutput&, const Model&, SignalMaker&);

}  // namespace pintle
