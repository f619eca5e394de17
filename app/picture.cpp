// pintle-picture DIR OUT: a frame of a run's animation as a picture, or all of them as a film, for `pintle picture` and `pintle film`.
// Reads what framework/drawing/vtk.h describes.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include <vtkObject.h>
#include <CLI/CLI.hpp>

#include "app/ffmpeg.h"
#include "app/field_picture.h"
#include "app/film.h"
#include "app/frames.h"
#include "app/options.h"
#include "app/progress.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle;

struct Choice {
  Drawn drawn;
  FilmPlan film;
  int frame = -1;                                          ///< counted from 0; from the end if negative
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]; the frame nearest to it
  std::string size;
  double deformation = 0, speed = 0;  ///< 0: not said
};

const FrameFiles& frame_of(const std::vector<FrameFiles>& frames, const Choice& choice) {
  const int count = static_cast<int>(frames.size()), n = choice.frame < 0 ? count + choice.frame : choice.frame;
  if (!std::isnan(choice.time))
    return *std::ranges::min_element(frames, {}, [&](const FrameFiles& frame) { return std::abs(frame.t - choice.time); });
  if (n < 0 || n >= count)
    throw std::runtime_error(choice.drawn.directory.string() + ": has " + std::to_string(count) + " frames, 0 to " +
                             std::to_string(count - 1) + "; asked for " + std::to_string(choice.frame));
  return frames[static_cast<std::size_t>(n)];
}

void write_picture(const Choice& choice) {
  const Drawing drawing = read_frame(frame_of(frames_of(choice.drawn.directory), choice), choice.drawn.deformation);
  Survey survey(choice.drawn.around, choice.drawn.style.field);
  survey.add(drawing);
  FramePicture picture(choice.drawn.style, survey, drawing);
  picture.draw(drawing);
  picture.canvas().write_png(choice.drawn.file);
}

void add_options(CLI::App& command, Choice& choice) {
  Drawn& drawn = choice.drawn;
  command
      .add_option("results", drawn.directory,
                  "a folder that run, kinematics, inverse or statics has written; or a .vtu of a body, with --field")
      ->required()
      ->type_name("DIR");
  command.add_option("out", drawn.file, "a picture (.png), or a film of all frames (.mp4, .webm, .gif); one that is there is replaced")
      ->required()
      ->type_name("OUT");
  command.add_option("--size", choice.size, "in pixels (default 1400, as high as needed)")->type_name("WIDTH[xHEIGHT]");
  command.add_option("--around", drawn.around, "fill the picture with this body, joint or force")->type_name("NAME");
  command.add_option("--field", drawn.style.field, "colour flexible bodies, or the .vtu file's, by this field, e.g. \"von Mises [Pa]\"")
      ->type_name("FIELD");
  command.add_option("--deformation", choice.deformation, "draw deformation so many times as large (default: as output.deformation says)")
      ->type_name("FACTOR")
      ->check(CLI::PositiveNumber);
  command.add_flag_callback(
      "--no-forces", [&drawn] { drawn.style.forces = false; }, "leave out the arrows of forces");
  command.add_flag_callback(
      "--no-paths", [&drawn] { drawn.style.paths = false; }, "leave out the paths of points");
  command.add_flag("-q,--quiet", drawn.quiet, "print nothing but errors");
  auto* frame = command.add_option("--frame", choice.frame, "of a picture: which frame, from 0; -1 is the last (default)")->type_name("N");
  command.add_option("--time", choice.time, "of a picture: the frame nearest to this time [s]")->excludes(frame)->type_name("T");
  command.add_option("--fps", choice.film.rate, "of a film: pictures a second (default 25)")->type_name("N")->check(CLI::Range(1.0, 240.0));
  command.add_option("--speed", choice.speed, "of a film: 1 as fast as it is, 0.01 a hundred times slower (default: every frame once)")
      ->type_name("FACTOR")
      ->check(CLI::PositiveNumber);
  command.add_option("--from", choice.film.from, "of a film: from this time [s]")->type_name("T");
  command.add_option("--to", choice.film.until, "of a film: until this time [s]")->type_name("T");
  command.footer(
      "Films are packed by ffmpeg (apt-get install ffmpeg). Slow motion is as smooth as the run has frames: --set output.frames=500.\n"
      "Exit codes: see pintle --help\n");
}

int write(Choice& choice) {
  Drawn& drawn = choice.drawn;
  if (!choice.size.empty() && std::sscanf(choice.size.c_str(), "%dx%d", &drawn.style.width, &drawn.style.height) < 1)
    throw std::invalid_argument("--size " + choice.size + ": give WIDTHxHEIGHT, such as 1400x600");
  if (choice.deformation > 0) drawn.deformation = choice.deformation;
  if (choice.speed > 0) choice.film.speed = choice.speed;
  if (FilmFile::is_film(drawn.file)) {
    if (write_film(drawn, choice.film)) return app::ok;
    std::cerr << "pintle: " << app::stopped_by() << "; there is no film\n";
    return app::stopped;
  }
  if (drawn.file.extension() != ".png")
    throw std::invalid_argument(drawn.file.string() + ": is neither a picture nor a film by its ending; write .png, .mp4, .webm or .gif");
  if (!drawn.style.field.empty() && !fs::is_directory(drawn.directory))
    write_field_picture(drawn.directory, drawn.style.field, drawn.style.width, drawn.file);
  else
    write_picture(choice);
  return app::ok;
}

}  // namespace

/// argv[0] is "pintle film" or "pintle picture" if the program pintle started it.
int main(int argc, char** argv) {
  app::leave_failed_writes_to_us();
  app::end_on_signals();
  const std::string name = fs::path(argv[0]).filename().string();
  const bool film = name == "pintle film";
  CLI::App command(film ? "Makes a film of a run, from the frames of its animation." : "Draws a frame of a run, or a field of a body.",
                   name);
  Choice choice;
  add_options(command, choice);
  try {
    command.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return command.exit(e) == 0 ? app::ok : app::bad_scene;
  }
  vtkObject::GlobalWarningDisplayOff();  // what fails is said below, once
  try {
    if (film && choice.drawn.file.extension() == ".png")
      throw std::invalid_argument(choice.drawn.file.string() +
                                  ": a film ends in .mp4, .webm or .gif; pictures are drawn by pintle picture");
    return write(choice);
  } catch (const std::invalid_argument& e) {
    std::cerr << "pintle: " << e.what() << '\n';
    return app::bad_scene;
  } catch (const std::exception& e) {
    std::cerr << "pintle: " << e.what() << '\n';
    return app::trouble;
  }
}
