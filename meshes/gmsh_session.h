#pragma once

#include <string>

/// Opening and closing Gmsh, for the files that mesh.
namespace pintle {

/// Gmsh, silent, for one task, with its own model and defaults. Only one at a time in a process.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// The errors in Gmsh's log so far, concatenated; empty: none.
std::string gmsh_errors();

}  // namespace pintle
