// Shows images in a browser on this machine while they are made: a small HTTP server on 127.0.0.1.
//
//   /             a page with the images
//   /stream.mjpg  the images as they come, at most 25 per second (multipart/x-mixed-replace)
//   /frame.jpg    the latest image
//
// Images are encoded only while a browser asks for them.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace swirl {

class FrameServer {
  public:
    /// `port` 0: any free one. Throws Failure if the port is in use.
    explicit FrameServer(int port);
    /// Ends all connections.
    ~FrameServer();
    FrameServer(const FrameServer&) = delete;
    FrameServer& operator=(const FrameServer&) = delete;

    std::string address() const;  // "http://127.0.0.1:8080/"
    /// The next image. `jpeg` may be called later, and from any thread, but once at most.
    void publish(std::function<std::string()> jpeg);

  private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace swirl
