#pragma once

#include <array>
#include <map>

#include "app/canvas.h"
#include "app/survey.h"

namespace pintle {

/// How frames are drawn, the same for all frames of a film.
struct PictureStyle {
  int width = 1400, height = 0;  ///< [px]; height 0: as the content asks
  bool even = false;             ///< both even, as films must be
  bool forces = true, paths = true;
  bool timeless = false;  ///< a body alone, that is at no time
  std::string field;      ///< of flexible bodies, in colour
};

/// Draws frames on a canvas of a fixed size: a uniform scale, time and names of the bodies above, scales below.
class FramePicture {
 public:
  /// @param first  of the frames, for the names of the bodies   @throws std::invalid_argument  the size does not do
  FramePicture(const PictureStyle&, const Survey&, const Drawing& first);

  Canvas& canvas() { return *canvas_; }
  int width() const { return width_; }
  int height() const { return height_; }
  void draw(const Drawing&);

 private:
  struct Label {
    int owner;
    double x;
    int row;
  };
  /// Below the picture, from the left, row after row.
  struct Note {
    enum Kind { lengths, forces, words } kind;
    std::string text;
    Colour colour;
    double symbol, width;  ///< of what stands before the text, and of both [px]
    double x = 0;
    int row = 0;
  };
  void fit();
  void choose_scale();
  Vector2d arrow_of(const DrawnForce&) const;
  Eigen::AlignedBox2d with_arrows() const;
  double arrow_share() const;
  void name_bodies(const Drawing&);
  void note_scales(const Drawing&);
  void place_notes();
  Vector2d place(const Vector2d& world) const;
  double arrow_pixels() const;

  void draw_flexible(const Drawing&);
  void draw_lines(const Drawing&, Part);
  void draw_joint(const DrawnLine&, const std::vector<Vector2d>&);
  void draw_forces(const Drawing&);
  void draw_head(const Drawing&);
  void draw_foot();
  int field_rows() const;
  void draw_field_scale();

  PictureStyle style_;
  Eigen::AlignedBox2d asked_, world_ = {};  ///< and with room about it
  double usual_force_, largest_couple_;
  std::vector<DrawnForce> forces_;  ///< whose arrows are to be inside
  FieldRange range_;
  std::array<bool, 4> givers_;                     ///< kinds of forces in some frame
  int width_, height_ = 0, top_ = 0, bottom_ = 0;  ///< [px]
  double small_ = 1;                               ///< letters and lines of small pictures are so many times as large
  double scale_ = 1;                               ///< [px/m]
  double shortened_ = 1;                           ///< arrows, so that they stay inside
  std::map<int, Colour> colours_;                  ///< of owners that are bodies with a shape
  std::vector<Label> labels_;
  std::vector<Note> notes_;
  int unnamed_ = 0;  ///< bodies for whose names there is no room
  std::unique_ptr<Canvas> canvas_;
};

}  // namespace pintle
