#include "swirl/render/frame_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <list>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "swirl/io/system_calls.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

namespace {

constexpr const char* live_page =
    "<!doctype html><meta charset=utf-8><title>swirl track --live</title>"
    "<style>body{margin:0;background:#111;display:grid;place-items:center;height:100vh}"
    "img{max-width:100vw;max-height:100vh}</style><img src=/stream.mjpg alt=\"live tracking\">";

constexpr std::string_view stream_head =
    "HTTP/1.1 200 OK\r\nConnection: close\r\nCache-Control: no-store\r\n"
    "Content-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n";

std::string http_answer(const char* status, const char* type, const std::string& body) {
    return fmt::format(
               "HTTP/1.1 {}\r\nConnection: close\r\nCache-Control: no-store\r\nContent-Type: "
               "{}\r\nContent-Length: {}\r\n\r\n",
               status, type, body.size()) +
           body;
}

/// Receives up to the empty line that ends a request; returns the path of a GET request, else "".
std::string requested_path(int connection) {
    constexpr std::size_t max_request = 8192;  // bytes
    constexpr int patience = 2000;             // ms
    std::string request;
    std::array<char, 2048> part{};
    while (request.find("\r\n\r\n") == request.npos && request.size() < max_request) {
        pollfd ready{connection, POLLIN, 0};
        if (::poll(&ready, 1, patience) <= 0) return "";
        const ssize_t got = ::recv(connection, part.data(), part.size(), 0);
        if (got <= 0) return "";
        request.append(part.data(), static_cast<std::size_t>(got));
    }
    if (!request.starts_with("GET ")) return "";
    return request.substr(4, request.find_first_of(" ?\r", 4) - 4);
}

}  // namespace

class FrameServer::State {
  public:
    explicit State(int port) {
        listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        const int yes = 1;
        socklen_t size = sizeof address;
        auto* const any = reinterpret_cast<sockaddr*>(&address);
        constexpr int backlog = 8;
        if (listener_ < 0 || ::fcntl(listener_, F_SETFD, FD_CLOEXEC) < 0 ||
            ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) < 0 ||
            ::bind(listener_, any, size) < 0 || ::listen(listener_, backlog) < 0 ||
            ::getsockname(listener_, any, &size) < 0) {
            const int error = errno;
            if (listener_ >= 0) ::close(listener_);
            throw Failure(
                fmt::format("cannot listen on port {} of 127.0.0.1: {}\nhint: choose "
                            "another port, or 0 for any free one",
                            port, std::strerror(error)));
        }
        port_ = ntohs(address.sin_port);
        acceptor_ = std::thread([this] { accept(); });
    }
    ~State() {
        closing_ = true;
        changed_.notify_all();
        acceptor_.join();
        for (Connection& one : connections_) one.thread.join();
        ::close(listener_);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    int port() const { return port_; }
    void publish(std::function<std::string()> jpeg) {
        {
            const std::lock_guard lock(mutex_);
            latest_ = std::make_shared<Published>();
            latest_->encode = std::move(jpeg);
            ++version_;
        }
        changed_.notify_all();
    }

  private:
    struct Published {
        std::function<std::string()> encode;
        std::once_flag once;
        std::string jpeg;
    };
    struct Connection {
        std::thread thread;
        std::shared_ptr<std::atomic<bool>> ended;
    };
    using Clock = std::chrono::steady_clock;

    void accept() {
        constexpr int interval = 100;  // ms
        constexpr std::size_t max_connections = 16;
        while (!closing_) {
            connections_.remove_if([](Connection& one) {
                if (*one.ended) one.thread.join();
                return bool(*one.ended);
            });
            pollfd ready{listener_, POLLIN, 0};
            if (::poll(&ready, 1, interval) <= 0) continue;
            const int connection = ::accept(listener_, nullptr, nullptr);
            if (connection < 0) continue;
            ::fcntl(connection, F_SETFD, FD_CLOEXEC);
            if (connections_.size() >= max_connections) {
                ::close(connection);
                continue;
            }
            const timeval patience{2, 0};
            ::setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
#if defined(SO_NOSIGPIPE)
            const int yes = 1;
            ::setsockopt(connection, SOL_SOCKET, SO_NOSIGPIPE, &yes, sizeof yes);
#endif
            auto ended = std::make_shared<std::atomic<bool>>(false);
            connections_.push_back({std::thread([this, connection, ended] {
                                        serve(connection);
                                        ::close(connection);
                                        *ended = true;
                                    }),
                                    ended});
        }
    }

    void serve(int connection) {
        const std::string path = requested_path(connection);
        if (path == "/") {
            send(connection, http_answer("200 OK", "text/html; charset=utf-8", live_page));
        } else if (path == "/frame.jpg") {
            std::uint64_t version = 0;
            const auto [jpeg, known] = newer_image(version, std::chrono::seconds(2));
            send(connection, known ? http_answer("200 OK", "image/jpeg", jpeg)
                                   : http_answer("503 Service Unavailable", "text/plain",
                                                 "There is no frame yet.\n"));
        } else if (path == "/stream.mjpg") {
            stream(connection);
        } else {
            send(connection, http_answer("404 Not Found", "text/plain", "Not found.\n"));
        }
    }

    void stream(int connection) {
        constexpr auto interval = std::chrono::milliseconds(40);
        if (!send(connection, stream_head)) return;
        for (std::uint64_t version = 0; !closing_;) {
            const auto begin = Clock::now();
            const auto [jpeg, known] = newer_image(version, std::chrono::seconds(1));
            if (known && !send(connection,
                               fmt::format("--frame\r\nContent-Type: image/jpeg\r\nContent-Length: "
                                           "{}\r\n\r\n",
                                           jpeg.size()) +
                                   jpeg + "\r\n"))
                return;
            std::this_thread::sleep_until(begin + interval);
        }
    }

    /// Waits for an image after this version; false if none came in time.
    std::pair<std::string, bool> newer_image(std::uint64_t& version, Clock::duration patience) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, patience, [&] { return version_ > version || closing_; });
        if (version_ <= version) return {"", false};
        const std::shared_ptr<Published> image = latest_;
        version = version_;
        lock.unlock();
        std::call_once(image->once, [&] {
            image->jpeg = image->encode();
            image->encode = nullptr;
        });
        return {image->jpeg, true};
    }

    static bool send(int connection, std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t sent = system::send(connection, bytes.data(), bytes.size());
            if (sent < 0 && errno == EINTR) continue;
            if (sent <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        }
        return true;
    }

    int listener_ = -1, port_ = 0;
    std::atomic<bool> closing_ = false;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::shared_ptr<Published> latest_;
    std::uint64_t version_ = 0;
    std::list<Connection> connections_;
    std::thread acceptor_;
};

FrameServer::FrameServer(int port) : state_(std::make_unique<State>(port)) {}
FrameServer::~FrameServer() = default;

std::string FrameServer::address() const {
    return fmt::format("http://127.0.0.1:{}/", state_->port());
}
void FrameServer::publish(std::function<std::string()> jpeg) { state_->publish(std::move(jpeg)); }

}  // namespace swirl
