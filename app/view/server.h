#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/view/session.h"

namespace pintle::app {

/// The page of a scene, served only to this machine: on 127.0.0.1, under a path that cannot be guessed. Only server.cpp includes httplib.h.
class ViewServer {
 public:
  /// @param port  0: any free port   @throws std::runtime_error  the port is not available
  ViewServer(ViewSession&, int port);
  ~ViewServer();
  std::string address() const;  ///< for a browser
  /// Serves until `stop` returns true; it is called several times a second.
  void serve(const std::function<bool()>& stop);

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace pintle::app
