#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/view/session.h"

namespace pintle::app {

/// The page of a scene, served to this machine alone: on 127.0.0.1, under a path that nobody can guess. server.cpp is the one file that
/// includes httplib.h.
class ViewServer {
 public:
  /// @param port  0: any that is free   @throws std::runtime_error  the port cannot be had
  ViewServer(ViewSession&, int port);
  ~ViewServer();
  std::string address() const;  ///< for a browser
  /// Serves until `stop` says so, which is asked some times a second.
  void serve(const std::function<bool()>& stop);

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace pintle::app
