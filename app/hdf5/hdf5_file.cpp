#include "app/hdf5/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "framework/common/file.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

/// Keeps the library's first message, which describes the origin of the error.
herr_t keep_first(unsigned, const H5E_error2_t* error, void* words) {
  std::string& kept = *static_cast<std::string*>(words);
  if (kept.empty() && error->desc) kept = error->desc;
  return 0;
}

/// @throws FileError  with the error of the system; if there is none, with the library's message
[[noreturn]] void fail(const fs::path& file) {
  std::string words;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &words);
  constexpr std::string_view before = "errno = ";
  int error = 0;
  if (const std::size_t at = words.rfind(before); at != std::string::npos)
    std::from_chars(words.data() + at + before.size(), words.data() + words.size(), error);
  if (error != 0) throw FileError(file, error);
  throw FileError(file, "HDF5 says: " + (words.empty() ? "no reason" : words));
}

/// @param result  of a function of the library: below 0 is an error
template <class T>
T checked(T result, const fs::path& file) {
  if (result < 0) fail(file);
  return result;
}

Hdf5Handle properties(hid_t kind, const fs::path& file) { return {checked(H5Pcreate(kind), file), H5Pclose}; }

Hdf5Handle text_type(const fs::path& file) {
  Hdf5Handle out{checked(H5Tcopy(H5T_C_S1), file), H5Tclose};
  checked(H5Tset_size(out.id(), H5T_VARIABLE), file);
  checked(H5Tset_cset(out.id(), H5T_CSET_UTF8), file);
  return out;
}

Hdf5Handle utf8_link(const fs::path& file) {
  Hdf5Handle out = properties(H5P_LINK_CREATE, file);
  checked(H5Pset_char_encoding(out.id(), H5T_CSET_UTF8), file);
  return out;
}

Hdf5Handle scalar(const fs::path& file) { return {checked(H5Screate(H5S_SCALAR), file), H5Sclose}; }

Hdf5Handle row_space(std::size_t rows, const fs::path& file) {
  const hsize_t size = rows;
  return {checked(H5Screate_simple(1, &size, nullptr), file), H5Sclose};
}

std::vector<const char*> pointers(std::span<const std::string> texts) {
  std::vector<const char*> out;
  out.reserve(texts.size());
  for (const std::string& text : texts) out.push_back(text.c_str());
  return out;
}

void add_attribute(const Hdf5Handle& object, const char* name, const Hdf5Handle& space, std::span<const std::string> texts,
                   const fs::path& file) {
  const Hdf5Handle type = text_type(file);
  const Hdf5Handle made{checked(H5Acreate2(object.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), file), H5Aclose};
  checked(H5Awrite(made.id(), type.id(), pointers(texts).data()), file);
}

/// How a column is stored.
Hdf5Handle storage(std::size_t rows, std::size_t chunk, const fs::path& file) {
  constexpr unsigned level = 1;  // higher levels compress shuffled numbers little better and take several times as long
  Hdf5Handle out = properties(H5P_DATASET_CREATE, file);
  if (rows == 0) return out;
  const hsize_t size = std::min(rows, chunk);
  checked(H5Pset_chunk(out.id(), 1, &size), file);
  checked(H5Pset_shuffle(out.id()), file);
  checked(H5Pset_deflate(out.id(), level), file);
  return out;
}

hid_t new_file(const fs::path& staging, const fs::path& path) {
  H5dont_atexit();  // after an error the library would try to write again
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Hdf5Handle access = properties(H5P_FILE_ACCESS, path);
  checked(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18), path);  // attributes above 64 kB; all programs read it
  checked(H5Pset_cache(access.id(), 0, 0, 0, 0), path);                              // blocks are written whole
  checked(H5Pset_file_locking(access.id(), false, true), path);                      // no other process knows its name
  return checked(H5Fcreate(staging.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access.id()), path);
}

}  // namespace

int Hdf5Handle::close() {
  const std::int64_t id = release();
  return id < 0 ? 0 : close_(id);
}

std::int64_t Hdf5Handle::release() {
  const std::int64_t id = id_;
  id_ = H5I_INVALID_HID;
  return id;
}

void Hdf5Table::write(std::size_t column, std::size_t row, std::size_t count, std::int64_t type, const void* values) {
  if (count == 0) return;
  const std::int64_t dataset = datasets_[column].id();
  const Hdf5Handle memory = row_space(count, file_);
  const Hdf5Handle place{checked(H5Dget_space(dataset), file_), H5Sclose};
  const hsize_t first = row, rows = count;
  checked(H5Sselect_hyperslab(place.id(), H5S_SELECT_SET, &first, nullptr, &rows, nullptr), file_);
  checked(H5Dwrite(dataset, type, memory.id(), place.id(), H5P_DEFAULT, values), file_);
}

void Hdf5Table::write(std::size_t column, std::size_t row, std::span<const double> values) {
  write(column, row, values.size(), H5T_NATIVE_DOUBLE, values.data());
}

void Hdf5Table::write(std::size_t column, std::size_t row, std::span<const std::string> texts) {
  write(column, row, texts.size(), text_type(file_).id(), pointers(texts).data());
}

Hdf5File::Hdf5File(fs::path path)
    : path_(std::move(path)), staging_{unique_neighbour(path_)}, file_(new_file(staging_.path, path_), H5Fclose) {}

Hdf5File::Staging::~Staging() {
  std::error_code ignored;
  fs::remove(path, ignored);
}

void Hdf5File::add_text(const std::string& name, const std::string& text) {
  const Hdf5Handle type = text_type(path_), space = scalar(path_), link = utf8_link(path_);
  const Hdf5Handle made{checked(H5Dcreate2(file_.id(), name.c_str(), type.id(), space.id(), link.id(), H5P_DEFAULT, H5P_DEFAULT), path_),
                        H5Dclose};
  const char* const words = text.c_str();
  checked(H5Dwrite(made.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &words), path_);
}

Hdf5Table Hdf5File::add_table(const std::string& name, const std::vector<Hdf5Column>& columns, std::size_t rows, std::size_t chunk) {
  const Hdf5Handle link = utf8_link(path_), text = text_type(path_), one = scalar(path_);
  const Hdf5Handle group{checked(H5Gcreate2(file_.id(), name.c_str(), link.id(), H5P_DEFAULT, H5P_DEFAULT), path_), H5Gclose};
  const Hdf5Handle space = row_space(rows, path_), stored = storage(rows, chunk, path_);
  Hdf5Table out(path_);
  std::vector<std::string> names;
  for (const Hdf5Column& column : columns) {
    const std::int64_t type = column.text ? text.id() : H5T_IEEE_F64LE;
    out.datasets_.emplace_back(
        checked(H5Dcreate2(group.id(), column.name.c_str(), type, space.id(), link.id(), stored.id(), H5P_DEFAULT), path_), H5Dclose);
    add_attribute(out.datasets_.back(), "unit", one, {&column.unit, 1}, path_);
    add_attribute(out.datasets_.back(), "heading", one, {&column.heading, 1}, path_);
    names.push_back(column.name);
  }
  add_attribute(group, "columns", row_space(names.size(), path_), names, path_);
  return out;
}

void Hdf5File::commit() {
  checked(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), path_);
  checked(file_.close(), path_);
  std::error_code error;
  fs::rename(staging_.path, path_, error);
  if (error) throw FileError(path_, error.value());
}

}  // namespace pintle::app
