#pragma once

#include <array>
#include <map>

#include "app/canvas.h"
#include "app/frames.h"
#include "app/survey.h"

namespace pintle {

struct PictureSize {
  int width, height;  ///< [px]
};

/// Style of frames, the same for all frames of a film.
struct PictureStyle {
  int width = 1400, height = 0;  ///< [px]; height 0: chosen by the content
  bool even = false;             ///< both even, as required for films
  bool forces = true, paths = true, impacts = true;
  bool timeless = false;  ///< a single body, without a time
  std::string field;      ///< of flexible bodies, in colour
};

/// Draws frames on a canvas of fixed size: a uniform scale, time and names of the bodies above, scales below.
class FramePicture {
 public:
  /// @param first  first frame, for the names of the bodies   @param impacts  each is drawn from its time on
  /// @throws std::invalid_argument  the size is invalid
  FramePicture(const PictureStyle&, const Survey&, const Drawing& first, std::vector<PlacedImpact> impacts = {});

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
  /// A note below the picture, from the left, row after row.
  struct Note {
    enum Kind { lengths, forces, words, impacts } kind;
    std::string text;
    Colour colour;
    double symbol, width;  ///< width of its symbol, and of symbol and text [px]
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
  void draw_impacts(double t);
  void draw_head(const Drawing&);
  void draw_foot();
  int field_rows() const;
  void draw_field_scale();

  PictureStyle style_;
  Eigen::AlignedBox2d asked_, world_ = {};  ///< as requested, and with a margin
  double usual_force_, largest_couple_;
  std::vector<DrawnForce> forces_;  ///< those whose arrows must be inside
  std::vector<PlacedImpact> impacts_;
  FieldRange range_;
  std::array<bool, 4> givers_;                     ///< kinds of forces that occur in any frame
  int width_, height_ = 0, top_ = 0, bottom_ = 0;  ///< [px]
  double small_ = 1;                               ///< scale of fonts and lines in small pictures
  double scale_ = 1;                               ///< [px/m]
  double shortened_ = 1;                           ///< factor of the arrows' lengths, so that they stay inside
  std::map<int, Colour> colours_;                  ///< of owners that are bodies with a shape
  std::vector<Label> labels_;
  std::vector<Note> notes_;
  int unnamed_ = 0;  ///< number of bodies without room for their names
  std::unique_ptr<Canvas> canvas_;
};

}  // namespace pintle
