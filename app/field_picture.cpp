#include "app/field_picture.h"

#include "app/frame_picture.h"
#include "app/frames.h"

namespace pintle {

PictureSize write_field_picture(const std::filesystem::path& file, PictureStyle style, const std::filesystem::path& picture) {
  Drawing drawing;
  drawing.bodies.push_back(read_body(file));
  drawing.owners = {drawing.bodies.back().name};
  style.timeless = true;
  Survey survey("", style.field);
  survey.add(drawing);
  FramePicture drawn(style, survey, drawing);
  drawn.draw(drawing);
  drawn.canvas().write_png(picture);
  return {drawn.width(), drawn.height()};
}

}  // namespace pintle
