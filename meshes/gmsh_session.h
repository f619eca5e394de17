#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

/// Gmsh opened and closed, for the files that mesh.
namespace pintle {

/// Gmsh, silent, for one piece of work, with a model of its own and defaults of its own. If
/// somebody else in the program has Gmsh open, his models stay and his options are put back.
/// Gmsh is one for the whole program: a second session waits until the first is closed.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

 private:
  std::unique_lock<std::mutex> alone_;
  bool mine_;
  std::string previous_, unit_before_;
  std::vector<std::pair<const char*, double>> before_;
};

/// The errors in Gmsh's log so far, one after the other; empty: none.
std::string gmsh_errors();

}  // namespace pintle
