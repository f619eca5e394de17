#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pintle::app {

/// An identifier of HDF5's library, and the function that closes it.
class Hdf5Handle {
 public:
  using Close = int (*)(std::int64_t);
  Hdf5Handle(std::int64_t id, Close closes) : id_(id), close_(closes) {}
  ~Hdf5Handle() { close(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.release()), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  std::int64_t id() const { return id_; }
  int close();  ///< @returns below 0: an error

 private:
  std::int64_t release();

  std::int64_t id_;
  Close close_;
};

/// A column of a table: a dataset of numbers or of text.
struct Hdf5Column {
  std::string name;           ///< of the dataset
  std::string unit, heading;  ///< its attributes
  bool text = false;
};

/// A table: a group with a dataset for each column.
class Hdf5Table {
 public:
  /// Writes values of a column from this row on. @throws FileError
  void write(std::size_t column, std::size_t row, std::span<const double>);
  void write(std::size_t column, std::size_t row, std::span<const std::string>);

 private:
  friend class Hdf5File;
  explicit Hdf5Table(std::filesystem::path file) : file_(std::move(file)) {}
  void write(std::size_t column, std::size_t row, std::size_t count, std::int64_t type, const void* values);

  std::filesystem::path file_;
  std::vector<Hdf5Handle> datasets_;
};

/// A new HDF5 file, written under a temporary name; `commit` moves it to its path, otherwise it is removed. Tables are not kept in memory.
class Hdf5File {
 public:
  /// @throws FileError
  explicit Hdf5File(std::filesystem::path);
  Hdf5File(const Hdf5File&) = delete;
  /// A scalar dataset of the root. @throws FileError
  void add_text(const std::string& name, const std::string& text);
  /// @param chunk  rows that are compressed together   @throws FileError
  Hdf5Table add_table(const std::string& name, const std::vector<Hdf5Column>&, std::size_t rows, std::size_t chunk);
  /// @pre no table is in use   @throws FileError
  void commit();

 private:
  struct Staging {
    std::filesystem::path path;
    ~Staging();  ///< removes it
  };

  std::filesystem::path path_;
  Staging staging_;
  Hdf5Handle file_;
};

}  // namespace pintle::app
