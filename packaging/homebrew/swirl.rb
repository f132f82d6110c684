# Homebrew formula. Not tested: no build on macOS was tried. `url` and `sha256` are placeholders.
class Swirl < Formula
  desc "Exact event-driven simulation of discs and spheres in a swirled container"
  homepage "https://doi.org/10.1103/PhysRevE.100.012903"
  url "https://example.org/swirl-1.0.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "MIT"

  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "tomlplusplus" => :build
  depends_on "cairo"
  depends_on "fmt"
  depends_on "hdf5"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja",
           "-DSWIRL_TESTS=OFF", "-DSWIRL_CAMERA=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
    pkgshare.install "packaging/test_installation.py"
  end

  test do
    system "python3", pkgshare/"test_installation.py", bin/"swirl"
  end
end
