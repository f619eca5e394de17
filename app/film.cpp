#include "app/film.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>

#include "app/ffmpeg.h"
#include "app/frames.h"
#include "app/progress.h"
#include "app/quantity.h"
#include "framework/common/text.h"

namespace pintle {

namespace {

std::size_t nearest_frame(const std::vector<double>& times, double t) {
  const auto after = std::ranges::lower_bound(times, t);
  if (after == times.begin()) return 0;
  if (after == times.end()) return times.size() - 1;
  const auto n = static_cast<std::size_t>(after - times.begin());
  return t - times[n - 1] < times[n] - t ? n - 1 : n;
}

std::string shown_time(double t) { return quantity(t, "s"); }

}  // namespace

std::vector<std::size_t> shown_frames(const std::vector<double>& times, const FilmPlan& plan) {
  const double tolerance = 1e-9 * std::max(std::abs(times.front()), std::abs(times.back()));
  std::vector<std::size_t> inside;
  for (std::size_t n = 0; n < times.size(); ++n)
    if (times[n] >= plan.from - tolerance && times[n] <= plan.until + tolerance) inside.push_back(n);
  if (inside.empty())
    throw std::invalid_argument("--from, --to: no frame lies between them; the frames are from " + shown_time(times.front()) + " to " +
                                shown_time(times.back()));
  if (!plan.speed) return inside;
  const double from = times[inside.front()], lasts = (times[inside.back()] - from) / *plan.speed;
  constexpr double most = 1e5;
  if (lasts * plan.rate > most)
    throw std::invalid_argument("--speed: the film would last " + shown_time(lasts) +
                                ", more than a hundred thousand pictures; choose a higher speed");
  std::vector<std::size_t> out;
  const auto count = static_cast<long>(std::floor(lasts * plan.rate * (1 + 1e-12))) + 1;
  for (long k = 0; k < count; ++k) out.push_back(nearest_frame(times, from + static_cast<double>(k) * *plan.speed / plan.rate));
  return out;
}

std::vector<PlacedImpact> shown_impacts(const Drawn& drawn, const FrameFiles& last) {
  if (!drawn.style.impacts) return {};
  std::vector<PlacedImpact> out = read_impacts(last);
  std::erase_if(out, [&](const PlacedImpact& impact) { return impact.t > last.t; });
  return out;
}

bool write_film(const Drawn& drawn, const FilmPlan& plan) {
  FilmFile::foresee(drawn.file);
  app::StatusLine line(drawn.quiet);
  app::now_doing("making the film");
  const std::vector<FrameFiles> frames = frames_of(drawn.directory);
  std::vector<double> times;
  for (const FrameFiles& frame : frames) times.push_back(frame.t);
  const std::vector<std::size_t> shown = shown_frames(times, plan);
  const auto tell = [&](const char* what, std::size_t n, const std::string& left = "") {
    if (line.due()) line.show(what + std::to_string(n + 1) + " of " + std::to_string(shown.size()) + left);
    return !app::asked_to_stop();
  };

  Survey survey(drawn.around, drawn.style.field);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (k > 0 && shown[k] == shown[k - 1]) continue;
    survey.add(read_frame(frames[shown[k]], drawn.deformation));
    if (!tell("reading frame ", k)) return false;
  }
  PictureStyle style = drawn.style;
  style.even = true;
  FramePicture picture(style, survey, read_frame(frames[shown.front()], drawn.deformation), shown_impacts(drawn, frames[shown.back()]));
  FilmFile film(drawn.file, picture.width(), picture.height(), plan.rate);
  app::now_doing("drawing the film");
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (k == 0 || shown[k] != shown[k - 1]) picture.draw(read_frame(frames[shown[k]], drawn.deformation));
    film.add(picture.canvas().pixels());
    const auto done = static_cast<double>(k + 1), all = static_cast<double>(shown.size());
    if (!tell("drawing picture ", k, app::time_left(done, all, app::doing_since()))) return false;
  }
  film.finish();
  if (!drawn.quiet)
    std::cout << "  " << drawn.file.string() << "  " << counted(shown.size(), "picture") << " of " << picture.width() << " x "
              << picture.height() << ", " << shown_time(static_cast<double>(shown.size()) / plan.rate) << "\n";
  return true;
}

}  // namespace pintle
