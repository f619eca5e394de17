#include "framework/drawing/vtu_text.h"

#include <bit>
#include <cstring>
#include <utility>

#include <lz4.h>

namespace pintle {

namespace {

// An array in the format that VTK reads: the number of blocks, the size of a full block and of the last one if it is not full, the
// compressed length of each; then the blocks.
std::string packed_array(std::string_view bytes) {
  constexpr std::size_t block = 32768;
  const std::size_t blocks = (bytes.size() + block - 1) / block;
  std::vector<std::uint64_t> header{blocks, block, bytes.size() % block};
  header.resize(header.size() + blocks);
  const std::size_t header_size = header.size() * sizeof header.front();
  std::string out(header_size, '\0');
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::string_view one = bytes.substr(b * block, block);
    const int most = LZ4_compressBound(static_cast<int>(one.size()));
    const std::size_t before = out.size();
    out.resize(before + static_cast<std::size_t>(most));
    const int packed = LZ4_compress_default(one.data(), out.data() + before, static_cast<int>(one.size()), most);
    header[3 + b] = static_cast<std::uint64_t>(packed);
    out.resize(before + static_cast<std::size_t>(packed));
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
  std::string bytes;  // each ends with a zero byte
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
