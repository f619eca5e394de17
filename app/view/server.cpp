#include "app/view/server.h"

#include <httplib.h>
#include <sys/random.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "app/view/page_parts.h"

namespace pintle::app {

namespace {

/// 128 random bits unknown to other processes.
std::string unguessable() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers, which are needed for an address that nobody can guess");
  std::string out;
  for (const unsigned char byte : bytes) {
    std::array<char, 3> digits{};
    std::snprintf(digits.data(), digits.size(), "%02x", byte);
    out += digits.data();
  }
  return out;
}

}  // namespace

struct ViewServer::Server {
  httplib::Server http;
  std::string token = unguessable();
  int port = 0;

  /// Whether a request is from our page, or from the user's browser for it: it names this address and does not come from another site.
  bool is_ours(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host"), origin = request.get_header_value("Origin");
    const std::string here = "127.0.0.1:" + std::to_string(port), site = request.get_header_value("Sec-Fetch-Site");
    return host == here && (origin.empty() || origin == "http://" + here) && (site.empty() || site == "same-origin" || site == "none");
  }
  /// @param path  within the page's folder, plain letters
  template <class Answer>
  httplib::Server::Handler answering(const char* type, const Answer& answer) {
    return [this, type, answer](const httplib::Request& request, httplib::Response& response) {
      if (!is_ours(request)) {
        response.status = 404;
        return;
      }
      if (const std::optional<std::string> body = answer(request))
        response.set_content(*body, type);
      else
        response.status = 400;
    };
  }
  template <class Answer>
  void get(const std::string& path, const char* type, const Answer& answer) {
    http.Get("/" + token + "/" + path, answering(type, answer));
  }
  template <class Answer>
  void post(const std::string& path, const Answer& answer) {
    http.Post("/" + token + "/" + path, answering("application/json", answer));
  }
};

ViewServer::ViewServer(ViewSession& session, int port) : server_(std::make_unique<Server>()) {
  httplib::Server& http = server_->http;
  constexpr std::size_t largest_request = 1 << 16;
  http.set_payload_max_length(largest_request);
  http.set_keep_alive_max_count(1000);
  http.set_socket_options([](socket_t) {});                          // otherwise two programs could share a port
  http.new_task_queue = [] { return new httplib::ThreadPool(32); };  // this many connections may be idle
  http.set_read_timeout(5);
  http.set_write_timeout(5);
  http.set_keep_alive_timeout(2);
  // Rejects a request with a body of unknown length: the server would wait for its end.
  http.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    const bool reads = request.method == "GET" || request.method == "HEAD", posts = request.method == "POST";
    if (reads || (posts && request.has_header("Content-Length"))) return httplib::Server::HandlerResponse::Unhandled;
    response.status = posts ? 411 : 405;
    response.set_header("Allow", "GET, HEAD, POST");
    response.set_header("Connection", "close");
    return httplib::Server::HandlerResponse::Handled;
  });
  http.set_default_headers({{"Content-Security-Policy",
                             "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; frame-ancestors 'none'; "
                             "base-uri 'none'; form-action 'none'"},
                            {"X-Content-Type-Options", "nosniff"},
                            {"Referrer-Policy", "no-referrer"},
                            {"Cache-Control", "no-store"}});
  const auto text = [](std::string_view part) { return [part](const httplib::Request&) { return std::string(part); }; };
  server_->get("", "text/html; charset=utf-8", text(page_parts::view_page));
  server_->get("view.css", "text/css; charset=utf-8", text(page_parts::view_style));
  server_->get("view.js", "text/javascript; charset=utf-8", text(page_parts::view_script));
  server_->get("now", "application/json", [&session](const httplib::Request& request) {
    return session.now(std::strtol(request.get_param_value("known").c_str(), nullptr, 10));
  });
  server_->post("drag", [&session](const httplib::Request& request) { return session.drag(request.body); });
  server_->post("again", [&session](const httplib::Request& request) {
    return request.body == "{}" ? std::optional(session.again()) : std::nullopt;
  });

  server_->port = port == 0 ? http.bind_to_any_port("127.0.0.1") : http.bind_to_port("127.0.0.1", port) ? port : -1;
  if (server_->port <= 0)
    throw std::runtime_error("--port " + std::to_string(port) +
                             ": is not available on 127.0.0.1; another program may use it. Choose another port");
}

ViewServer::~ViewServer() = default;

std::string ViewServer::address() const { return "http://127.0.0.1:" + std::to_string(server_->port) + "/" + server_->token + "/"; }

void ViewServer::serve(const std::function<bool()>& stop) {
  std::exception_ptr trouble;
  std::atomic<bool> over = false;
  std::thread serving([&] {
    try {
      server_->http.listen_after_bind();  // starts threads of its own
    } catch (...) {
      trouble = std::current_exception();
    }
    over = true;
  });
  while (!over && !stop()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server_->http.stop();
  serving.join();
  if (trouble) std::rethrow_exception(trouble);
}

}  // namespace pintle::app
