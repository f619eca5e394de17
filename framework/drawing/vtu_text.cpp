#include "framework/drawing/vtu_text.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace pintle {

namespace {

// --- blocks of LZ4: sequences of literal bytes and a match, what stood `offset` bytes before; the last has literals only ---

constexpr std::size_t shortest_match = 4, most_in_token = 15;

void append_rest_of_length(std::string& out, std::size_t length) {
  if (length < most_in_token) return;
  length -= most_in_token;
  out.append(length / 255, '\xff');
  out += static_cast<char>(length % 255);
}

void append_token(std::string& out, std::size_t literals, std::size_t beyond_shortest) {
  out += static_cast<char>(std::min(literals, most_in_token) << 4 | std::min(beyond_shortest, most_in_token));
}

void append_literals(std::string& out, std::string_view literals) {
  append_token(out, literals.size(), 0);
  append_rest_of_length(out, literals.size());
  out += literals;
}

void append_sequence(std::string& out, std::string_view literals, std::size_t match) {
  constexpr std::string_view offset("\x01\x00", 2);
  append_token(out, literals.size(), match - shortest_match);
  append_rest_of_length(out, literals.size());
  out += literals;
  out += offset;
  append_rest_of_length(out, match - shortest_match);
}

/// Of a run of zero words the first byte is a literal, and the rest repeats it.
void append_lz4_block(std::string& out, std::string_view bytes) {
  constexpr std::size_t word = sizeof(std::uint64_t), kept_at_end = 12;  // where the format lets no match begin
  const std::size_t words = bytes.size() > kept_at_end ? (bytes.size() - kept_at_end) / word : 0;
  const auto is_zero = [&](std::size_t w) {
    std::uint64_t value;
    std::memcpy(&value, bytes.data() + w * word, word);
    return value == 0;
  };
  std::size_t written = 0;
  for (std::size_t w = 0; w < words; ++w) {
    if (!is_zero(w)) continue;
    const std::size_t begin = w;
    while (w + 1 < words && is_zero(w + 1)) ++w;
    append_sequence(out, bytes.substr(written, begin * word + 1 - written), (w + 1 - begin) * word - 1);
    written = (w + 1) * word;
  }
  append_literals(out, bytes.substr(written));
}

// --- arrays as VTK reads them: the number of blocks, the size of a whole one and of the last, if that is no whole one, how long each
//     is when packed; then the blocks ---

std::string packed_array(std::string_view bytes) {
  constexpr std::size_t block = 32768;
  const std::size_t blocks = (bytes.size() + block - 1) / block;
  std::vector<std::uint64_t> header{blocks, block, bytes.size() % block};
  header.resize(header.size() + blocks);
  const std::size_t header_size = header.size() * sizeof header.front();
  std::string out(header_size, '\0');
  out.reserve(header_size + bytes.size() + bytes.size() / 64 + 16 * blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t before = out.size();
    append_lz4_block(out, bytes.substr(b * block, block));
    header[3 + b] = out.size() - before;
  }
  std::memcpy(out.data(), header.data(), header_size);
  return out;
}

template <class Value>
VtuText::Packed packed_values(const char* type, std::span<const Value> values) {
  return {type, values.size(), packed_array({reinterpret_cast<const char*>(values.data()), values.size_bytes()})};
}

void append_attribute(std::string& out, std::string_view name, std::string_view value) {
  out += ' ';
  out += name;
  out += "=\"";
  for (const char c : value) switch (c) {
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '&': out += "&amp;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  out += '"';
}

}  // namespace

VtuText::Packed VtuText::pack(std::span<const double> values) { return packed_values("Float64", values); }
VtuText::Packed VtuText::pack(std::span<const float> values) { return packed_values("Float32", values); }
VtuText::Packed VtuText::pack(std::span<const std::int32_t> values) { return packed_values("Int32", values); }
VtuText::Packed VtuText::pack(std::span<const unsigned char> values) { return packed_values("UInt8", values); }

VtuText::Packed VtuText::pack(std::span<const std::string> values) {
  std::string bytes;  // each ends with a zero
  for (const std::string& value : values) bytes.append(value.c_str(), value.size() + 1);
  return {"String", values.size(), packed_array(bytes)};
}

void VtuText::add(Section section, std::string_view name, Packed array, int components) {
  std::string& head = heads_[section];
  head += array.type == "String" ? "<Array" : "<DataArray";
  append_attribute(head, "type", array.type);
  append_attribute(head, "Name", name);
  if (components > 1) append_attribute(head, "NumberOfComponents", std::to_string(components));
  if (section == of_frame) append_attribute(head, "NumberOfTuples", std::to_string(array.values));
  append_attribute(head, "format", "appended");
  append_attribute(head, "offset", std::to_string(bytes_));
  head += "/>\n";
  bytes_ += array.bytes.size();
  data_.push_back(std::move(array.bytes));
}

std::string VtuText::text(std::size_t n_points, std::size_t n_cells) const {
  std::string out = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
  out += std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  out += "\" header_type=\"UInt64\" compressor=\"vtkLZ4DataCompressor\">\n<UnstructuredGrid>\n<FieldData>\n";
  out += heads_[of_frame];
  out += "</FieldData>\n<Piece";
  append_attribute(out, "NumberOfPoints", std::to_string(n_points));
  append_attribute(out, "NumberOfCells", std::to_string(n_cells));
  out += ">\n<PointData>\n";
  out += heads_[on_points];
  out += "</PointData>\n<CellData>\n";
  out += heads_[on_cells];
  out += "</CellData>\n<Points>\n";
  out += heads_[places];
  out += "</Points>\n<Cells>\n";
  out += heads_[cells];
  out += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  out.reserve(out.size() + bytes_ + 64);
  for (const std::string& array : data_) out += array;
  out += "\n</AppendedData>\n</VTKFile>\n";
  return out;
}

}  // namespace pintle
