#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// An unstructured grid as the text of a .vtu file, made without VTK: some XML, then the arrays as in memory ("appended", "raw") in blocks
/// compressed by LZ4, which VTK and ParaView can read.
class VtuText {
 public:
  /// Section of an array. VTK requires `connectivity`, `offsets` and `types` for the cells, and `Points` for the places.
  enum Section { of_frame, on_points, on_cells, places, cells };

  /// An array prepared for several files.
  struct Packed {
    std::string type;
    std::size_t values = 0;
    std::string bytes;
  };
  static Packed pack(std::span<const double>);
  static Packed pack(std::span<const float>);
  static Packed pack(std::span<const std::int32_t>);
  static Packed pack(std::span<const unsigned char>);
  static Packed pack(std::span<const std::string>);

  void add(Section, std::string_view name, Packed, int components = 1);
  template <class Values>
  void add(Section section, std::string_view name, const Values& values, int components = 1) {
    add(section, name, pack(std::span(values)), components);
  }
  void add_number(std::string_view name, double value) { add(of_frame, name, std::array{value}); }

  std::string text(std::size_t n_points, std::size_t n_cells) const;

 private:
  std::array<std::string, 5> heads_;  ///< of the arrays, section by section
  std::vector<std::string> data_;
  std::size_t bytes_ = 0;  ///< of the data
};

}  // namespace pintle
