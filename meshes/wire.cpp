#include "meshes/wire.h"

#include <sys/socket.h>

#include <cerrno>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace pintle {

namespace {

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

[[noreturn]] void spoilt() { throw std::runtime_error("the mesher's answer is damaged; please report this"); }

struct Packer {
  std::string bytes{};

  template <Number T>
  void one(const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void size(std::size_t n) { one(std::uint64_t{n}); }
  template <class List, class Pass>
  void each(List& list, Pass pass_one) {
    size(list.size());
    for (auto& one : list) pass_one(one);
  }
};

struct Unpacker {
  std::string_view rest;

  template <Number T>
  void one(T& value) {
    if (rest.size() < sizeof value) spoilt();
    std::memcpy(&value, rest.data(), sizeof value);
    rest.remove_prefix(sizeof value);
  }
  std::uint64_t size() {
    std::uint64_t n = 0;
    one(n);
    if (n > rest.size()) spoilt();  // every item has at least one byte
    return n;
  }
  /// Grows only with the data present, not with the stated length.
  template <class List, class Pass>
  void each(List& list, Pass pass_one) {
    list.clear();
    for (std::uint64_t k = size(); k > 0; --k) {
      typename List::value_type one{};
      pass_one(one);
      list.push_back(std::move(one));
    }
  }
};

// One description for both directions: `pass` writes its argument, or reads into it.

template <class Archive, Number T>
void pass(Archive& a, T& value) {
  a.one(value);
}

template <class Archive>
void pass(Archive& a, bool& value) {
  char c = value;
  a.one(c);
  value = c != 0;
}

template <class Archive>
void pass(Archive& a, Eigen::Vector2d& v) {
  a.one(v[0]), a.one(v[1]);
}

template <class Archive, class T>
void pass(Archive& a, std::vector<T>& all);

template <class Archive>
void pass(Archive& a, std::string& text) {
  a.each(text, [&](char& c) { a.one(c); });
}

template <class Archive>
void pass(Archive& a, Eye& e) {
  a.one(e.bore), a.one(e.outer);
}
template <class Archive>
void pass(Archive& a, StraightBar& l) {
  a.one(l.length), a.one(l.width);
}
template <class Archive>
void pass(Archive& a, TaperedBar& l) {
  a.one(l.length), a.one(l.width_left), a.one(l.width_right);
}
template <class Archive>
void pass(Archive& a, Disc& l) {
  a.one(l.diameter), a.one(l.bore);
}
template <class Archive>
void pass(Archive& a, EyeBar& l) {
  a.one(l.length), a.one(l.width), pass(a, l.first), pass(a, l.second);
}
template <class Archive>
void pass(Archive& a, Triangle& l) {
  for (std::size_t i = 0; i < 3; ++i) pass(a, l.center[i]), pass(a, l.eye[i]);
}

template <std::size_t kind = 0>
Link link_of_kind(std::size_t wanted) {
  if constexpr (kind == std::variant_size_v<Link>)
    spoilt();
  else if (wanted == kind)
    return std::variant_alternative_t<kind, Link>{};
  else
    return link_of_kind<kind + 1>(wanted);
}

template <class Archive>
void pass(Archive& a, std::optional<Link>& link) {
  std::uint64_t kind = link ? link->index() + 1 : 0;
  a.one(kind);
  if (kind == 0) return link.reset();
  if (!link || link->index() + 1 != kind) link = link_of_kind(static_cast<std::size_t>(kind - 1));
  std::visit([&](auto& l) { pass(a, l); }, *link);
}

template <class Archive>
void pass(Archive& a, MeshOptions& o) {
  a.one(o.shape), a.one(o.size), a.one(o.hole_size), pass(a, o.points);
}
template <class Archive>
void pass(Archive& a, Cells& c) {
  a.one(c.shape), pass(a, c.nodes), pass(a, c.numbers);
}
template <class Archive>
void pass(Archive& a, Group& g) {
  pass(a, g.name), pass(a, g.nodes), pass(a, g.sides);
}

template <class Archive, class T>
void pass(Archive& a, std::vector<T>& all) {
  a.each(all, [&](T& one) { pass(a, one); });
}

template <class Archive>
void pass(Archive& a, MesherTask& t) {
  pass(a, t.link), pass(a, t.file), a.one(t.scale), pass(a, t.options), pass(a, t.at), pass(a, t.folders);
  pass(a, t.unconfined), a.one(t.most_bytes);
}

template <class Archive>
void pass(Archive& a, Mesh& m) {
  std::vector<Eigen::Vector2d> x(m.x.colwise().begin(), m.x.colwise().end());
  pass(a, x);
  m.x.resize(2, static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) m.x.col(static_cast<Eigen::Index>(i)) = x[i];
  pass(a, m.node_numbers), pass(a, m.cells), pass(a, m.groups);
}

template <class T>
std::string bytes_of(T value) {  // a copy, because `pass` takes an argument that it could read into
  Packer packer;
  pass(packer, value);
  return std::move(packer.bytes);
}

template <class T>
T read_back(std::string_view bytes) {
  T value;
  Unpacker unpacker{bytes};
  pass(unpacker, value);
  if (!unpacker.rest.empty()) spoilt();
  return value;
}

// Users of the mesh rely on this, and the process that made it has read a file of unknown origin.
void validate(const std::vector<int>& nodes, std::size_t count) {
  if (std::ranges::any_of(nodes, [&](int n) { return n < 0 || static_cast<std::size_t>(n) >= count; })) spoilt();
}
void validate(const std::vector<Cells>& blocks, std::size_t count) {
  for (const Cells& c : blocks) {
    if (c.shape < CellShape::line2 || c.shape > CellShape::quadrilateral9) spoilt();
    if (c.nodes.size() != c.numbers.size() * static_cast<std::size_t>(nodes_of(c.shape))) spoilt();
    validate(c.nodes, count);
  }
}

}  // namespace

std::string packed(const MesherTask& task) { return bytes_of(task); }
std::string packed(const Mesh& mesh) { return bytes_of(mesh); }
MesherTask unpacked_task(std::string_view bytes) { return read_back<MesherTask>(bytes); }

Mesh unpacked_mesh(std::string_view bytes) {
  Mesh mesh = read_back<Mesh>(bytes);
  const std::size_t count = static_cast<std::size_t>(mesh.x.cols());
  if (mesh.node_numbers.size() != count) spoilt();
  validate(mesh.cells, count);
  for (const Group& g : mesh.groups) validate(g.nodes, count), validate(g.sides, count);
  return mesh;
}

namespace {

bool send_all(int socket, const void* data, std::size_t size) {
  for (const char* at = static_cast<const char*>(data); size > 0;) {
    const ssize_t n = ::send(socket, at, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n, size -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

bool send_message(int socket, const std::string& words) {
  const std::uint64_t length = words.size();
  return send_all(socket, &length, sizeof length) && send_all(socket, words.data(), words.size());
}

}  // namespace pintle
