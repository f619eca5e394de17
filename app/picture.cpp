// pintle-picture DIR OUT: a frame of a run's animation as a picture, or all of them as a film, for `pintle picture` and `pintle film`.
// Reads the files described in framework/drawing/vtk.h.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include <vtkObject.h>
#include <CLI/CLI.hpp>

#include "app/failure.h"
#include "app/ffmpeg.h"
#include "app/field_picture.h"
#include "app/film.h"
#include "app/frames.h"
#include "app/mistyped.h"
#include "app/options.h"
#include "app/progress.h"
#include "framework/common/file_names.h"
#include "framework/common/text.h"
#include "framework/scene/error.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle;

struct Choice {
  Drawn drawn;
  FilmPlan film;
  int frame = -1;                                          ///< counted from 0; from the end if negative
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]; the frame nearest to it
  std::string size;
  double deformation = 0, speed = 0;  ///< 0: not given
};

const FrameFiles& frame_of(const std::vector<FrameFiles>& frames, const Choice& choice) {
  const int count = static_cast<int>(frames.size()), n = choice.frame < 0 ? count + choice.frame : choice.frame;
  if (!std::isnan(choice.time)) {
    const double first = frames.front().t, last = frames.back().t, off = 1e-9 * std::abs(last - first);
    if (choice.time < first - off || choice.time > last + off)
      std::cerr << "warning: --time " << choice.time << ": the frames of " << choice.drawn.directory.string() << " are from " << first
                << " to " << last << " s; the nearest is drawn\n";
    return *std::ranges::min_element(frames, {}, [&](const FrameFiles& frame) { return std::abs(frame.t - choice.time); });
  }
  if (n < 0 || n >= count)
    throw std::invalid_argument("--frame: " + choice.drawn.directory.string() + " has " + counted(frames.size(), "frame") +
                                (count == 1 ? ", number 0" : ", 0 to " + std::to_string(count - 1)) + "; asked for " +
                                std::to_string(choice.frame));
  return frames[static_cast<std::size_t>(n)];
}

/// @returns its size
PictureSize write_picture(const Choice& choice) {
  const std::vector<FrameFiles> frames = frames_of(choice.drawn.directory);
  const FrameFiles& frame = frame_of(frames, choice);
  const Drawing drawing = read_frame(frame, choice.drawn.deformation);
  Survey survey(choice.drawn.around, choice.drawn.style.field);
  survey.add(drawing);
  FramePicture picture(choice.drawn.style, survey, drawing, shown_impacts(choice.drawn, frame));
  picture.draw(drawing);
  picture.canvas().write_png(choice.drawn.file);
  return {picture.width(), picture.height()};
}

/// @returns NaN: not a number
double number_of(const std::string& text) {
  double out = 0;
  return CLI::detail::lexical_cast(text, out) ? out : std::numeric_limits<double>::quiet_NaN();
}
CLI::Validator above_zero() {
  const auto complaint = [](const std::string& text) {
    const double x = number_of(text);
    return std::isfinite(x) && x > 0 ? "" : text + " is not a number above 0; write one such as 0.01";
  };
  return {complaint, ""};
}
CLI::Validator finite() {
  const auto complaint = [](const std::string& text) {
    return std::isfinite(number_of(text)) ? "" : text + " is not a time; write a number of seconds";
  };
  return {complaint, ""};
}

void read_size(const std::string& text, PictureStyle& style) {
  constexpr int least = 200, most = 8000;
  const char* const end = text.data() + text.size();
  const auto [x, no_width] = std::from_chars(text.data(), end, style.width);
  bool right = no_width == std::errc() && style.width >= least && style.width <= most;
  if (right && x != end) {
    const auto [rest, no_height] = std::from_chars(x + 1, end, style.height);
    right = *x == 'x' && no_height == std::errc() && rest == end && style.height >= least && style.height <= most;
  }
  if (!right)
    throw std::invalid_argument("--size " + text + ": write WIDTH or WIDTHxHEIGHT in pixels, from 200 to 8000 each, such as 1400x800");
}

void add_options(CLI::App& command, Choice& choice) {
  Drawn& drawn = choice.drawn;
  command
      .add_option("results", drawn.directory, "results folder of run, kinematics, inverse or statics; or a .vtu of a body, with --field")
      ->required()
      ->type_name("DIR");
  command.add_option("out", drawn.file, "a picture (.png), or a film of all frames (.mp4, .webm, .gif); an existing file is replaced")
      ->required()
      ->type_name("OUT");
  command.add_option("--size", choice.size, "in pixels (default 1400, as high as needed)")->type_name("WIDTH[xHEIGHT]");
  command.add_option("--around", drawn.around, "fill the picture with this body or joint, or show what is near this force")
      ->type_name("NAME");
  command.add_option("--field", drawn.style.field, "colour flexible bodies, or the .vtu file's, by this field, e.g. \"von Mises [Pa]\"")
      ->type_name("FIELD");
  command.add_option("--deformation", choice.deformation, "factor by which deformation is magnified (default: output.deformation)")
      ->type_name("FACTOR")
      ->check(above_zero());
  command.add_flag_callback(
      "--no-forces", [&drawn] { drawn.style.forces = false; }, "leave out the arrows of forces");
  command.add_flag_callback(
      "--no-paths", [&drawn] { drawn.style.paths = false; }, "leave out the paths of points");
  command.add_flag_callback(
      "--no-impacts", [&drawn] { drawn.style.impacts = false; }, "leave out the points where surfaces met");
  command.add_flag("-q,--quiet", drawn.quiet, "print errors only");
  auto* frame = command.add_option("--frame", choice.frame, "of a picture: which frame, from 0; -1 is the last (default)")->type_name("N");
  command.add_option("--time", choice.time, "of a picture: the frame nearest to this time [s]")
      ->excludes(frame)
      ->type_name("T")
      ->check(finite());
  command.add_option("--fps", choice.film.rate, "of a film: pictures per second (default 25)")
      ->type_name("N")
      ->check(CLI::Range(1.0, 240.0));
  command.add_option("--speed", choice.speed, "of a film: 1 is real time, 0.01 a hundred times slower (default: every frame once)")
      ->type_name("FACTOR")
      ->check(above_zero());
  command.add_option("--from", choice.film.from, "of a film: from this time [s]")->type_name("T")->check(finite());
  command.add_option("--to", choice.film.until, "of a film: until this time [s]")->type_name("T")->check(finite());
  command.footer(
      "Films are encoded by ffmpeg (apt-get install ffmpeg). For smooth slow motion, run with more frames: --set output.frames=500.\n"
      "Exit codes: see pintle --help\n");
}

/// Hides options in the help that are only for the other command.
void tailor_help(CLI::App& command, const std::string& name) {
  const auto hide = [&](std::initializer_list<const char*> options) {
    for (const char* const option : options) command.get_option(option)->group("");
  };
  if (name == "pintle film") {
    hide({"--frame", "--time"});
    command.get_option("results")->description("results folder of run, kinematics, inverse or statics");
    command.get_option("out")->description("a film of all frames (.mp4, .webm, .gif); an existing file is replaced");
  }
  if (name == "pintle picture") {
    hide({"--fps", "--speed", "--from", "--to"});
    command.get_option("out")->description("a picture (.png); an existing file is replaced");
    command.footer("Exit codes: see pintle --help\n");
  }
}

/// Rejects options that have no effect here and would otherwise be ignored.
void refuse_options(const CLI::App& command, std::initializer_list<const char*> names, const std::string& why) {
  for (const char* const name : names)
    if (command.count(name) > 0) throw std::invalid_argument(std::string(name) + " " + why);
}

/// " it has a [Pa], b [Pa]" for a body's file, empty if it cannot be read.
std::string fields_in(const fs::path& file) {
  std::string names;
  try {
    for (const Field& field : read_body(file).fields) names += (names.empty() ? "; it has " : ", ") + field.name;
  } catch (const std::runtime_error&) {
  }
  return names;
}

/// @throws std::invalid_argument  the input is not a folder of results but an unsuitable file
void validate_input(const CLI::App& command, const Choice& choice, bool film) {
  const fs::path& given = choice.drawn.directory;
  if (!fs::is_regular_file(given)) return;
  const std::string ending = ending_of(given), folder = given.has_parent_path() ? given.parent_path().string() : ".";
  if (ending == ".pvd") throw std::invalid_argument(given.string() + ": is a file of a run; name its folder, " + folder);
  if (ending != ".vtu")
    throw std::invalid_argument(given.string() +
                                ": is a file; name the folder of its results, which `pintle run` writes with --out FOLDER");
  if (film) throw std::invalid_argument(given.string() + ": shows one instant; a film is made from the folder of a run");
  if (choice.drawn.style.field.empty())
    throw std::invalid_argument(given.string() + ": choose the field of the body to draw with --field NAME" + fields_in(given) +
                                "; of a run name its folder");
  refuse_options(command, {"--around", "--deformation", "--frame", "--time", "--no-forces", "--no-impacts", "--no-paths"},
                 "is for folders of runs; " + given.string() + " is one body");
}

int write(const CLI::App& command, Choice& choice) {
  Drawn& drawn = choice.drawn;
  const bool film = FilmFile::is_film(drawn.file);
  if (!film && ending_of(drawn.file) != ".png")
    throw std::invalid_argument(drawn.file.string() +
                                ": its ending is neither that of a picture nor of a film; write .png, .mp4, .webm or .gif");
  if (film)
    refuse_options(command, {"--frame", "--time"}, "is an option of pintle picture; choose the part of a film with --from and --to");
  else
    refuse_options(command, {"--fps", "--speed", "--from", "--to"}, "is an option of pintle film; choose a picture with --frame or --time");
  if (choice.film.from > choice.film.until) throw std::invalid_argument("--from is after --to; write the earlier time as --from");
  if (command.count("--size") > 0) read_size(choice.size, drawn.style);
  if (choice.deformation > 0) drawn.deformation = choice.deformation;
  if (choice.speed > 0) choice.film.speed = choice.speed;
  validate_input(command, choice, film);
  if (film) {
    if (write_film(drawn, choice.film)) return app::ok;
    std::cerr << "pintle: " << app::stopped_by() << "; there is no film\n";
    return app::stopped;
  }
  const bool of_body = fs::is_regular_file(drawn.directory);
  const PictureSize size = of_body ? write_field_picture(drawn.directory, drawn.style, drawn.file) : write_picture(choice);
  if (!drawn.quiet) std::cout << "  " << drawn.file.string() << "  " << size.width << " x " << size.height << "\n";
  return app::ok;
}

/// @throws std::invalid_argument  the file's ending does not fit the command
void validate_ending(const std::string& name, const fs::path& file) {
  if (name == "pintle film" && !FilmFile::is_film(file))
    throw std::invalid_argument(file.string() + ": a film ends in .mp4, .webm or .gif; pictures are drawn by pintle picture");
  if (name == "pintle picture" && ending_of(file) != ".png")
    throw std::invalid_argument(file.string() + ": a picture ends in .png; films are made by pintle film");
}

/// argv[0] is "pintle film" or "pintle picture" if it was started by the program pintle.
int carry_out(int argc, char** argv) {
  const std::string name = fs::path(argv[0]).filename().string();
  const bool film = name == "pintle film";
  CLI::App command(film ? "Makes a film of a run, from the frames of its animation." : "Draws a frame of a run, or a field of a body.",
                   name);
  Choice choice;
  add_options(command, choice);
  tailor_help(command, name);
  return app::parse_and_run(command, argc, argv, [&] {
    vtkObject::GlobalWarningDisplayOff();  // errors are reported below, once
    try {
      validate_ending(name, choice.drawn.file);
      return write(command, choice);
    } catch (const std::invalid_argument& e) {
      throw SceneError(e.what());  // the command line is wrong
    }
  });
}

}  // namespace

int main(int argc, char** argv) { return app::run_program(argc, argv, carry_out); }
