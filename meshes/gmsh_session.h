#pragma once

#include <string>

/// Gmsh opened and closed, for the files that mesh.
namespace pintle {

/// Gmsh, silent, for one piece of work, with a model and defaults of its own. One at a time in a process.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// The errors in Gmsh's log so far, one after the other; empty: none.
std::string gmsh_errors();

}  // namespace pintle
