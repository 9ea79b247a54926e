// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <png.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace terracut::test {

/// A headless browser of this machine.
class Browser {
 public:
  /// None where no known one is installed.
  [[nodiscard]] static std::optional<Browser> find() {
    for (const char* const name : {"chromium", "chromium-browser", "google-chrome"}) {
      const std::string command = std::string("command -v ") + name + " >/dev/null 2>&1";
      if (std::system(command.c_str()) == 0) return Browser(name);
    }
    return {};
  }

  struct View {
    bool done = false;
    std::vector<std::string> console;  ///< What the page, or the browser about it, said there.
    std::filesystem::path screenshot;
  };
  /// Opens a page, with `scratch` for the browser's own files.
  [[nodiscard]] View open(const std::filesystem::path& page,
                          const std::filesystem::path& scratch) const {
    View view;
    view.screenshot = scratch / (page.stem().string() + ".png");
    const std::filesystem::path log = scratch / "browser.log";
    const std::string command = "timeout 200 " + name_ +
                                " --headless --no-sandbox --disable-gpu --hide-scrollbars"
                                " --enable-logging=stderr --window-size=1280,2400"
                                " --user-data-dir='" +
                                (scratch / "profile").string() + "' --screenshot='" +
                                view.screenshot.string() + "' 'file://" + page.string() + "' >'" +
                                log.string() + "' 2>&1";
    view.done = std::system(command.c_str()) == 0;
    std::ifstream file(log);
    for (std::string line; std::getline(file, line);) {
      if (line.find("CONSOLE") != std::string::npos) view.console.push_back(line);
    }
    return view;
  }

 private:
  explicit Browser(std::string name) : name_(std::move(name)) {}

  std::string name_;
};

/// How many colours a PNG file has; 0 when it is none.
[[nodiscard]] inline std::size_t colours_in(const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0) return 0;
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint32_t> pixels(std::size_t{image.width} * image.height);
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) return 0;
  return std::set(pixels.begin(), pixels.end()).size();
}

}  // namespace terracut::test
