// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What others may have put into the folders of `relabel`, `compare` and `--labels`: files of any
// content, links, pipes and folders in the place of jobs, records, facts, sums, settings, labels
// and lists, while a shard is labelled, looked at and compared. Nothing outside is written to or
// removed, nobody waits, what is said suits a terminal, and the drive beside the bad one gets its
// labels.
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "input.hpp"
#include "pipeline/output/frame_folder.hpp"
#include "pipeline/output/label_sink.hpp"
#include "tools/cli/compare/label_changes.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/fleet/content_hash.hpp"
#include "tools/cli/fleet/drive_labelling.hpp"
#include "tools/cli/fleet/labelled_drive.hpp"
#include "tools/cli/fleet/relabel_job.hpp"
#include "tools/cli/fleet/relabel_status.hpp"
#include "tools/cli/fleet/shard_run.hpp"
#include "tools/cli/terminal_text.hpp"

namespace {

namespace fs = std::filesystem;
using namespace terracut;
using terracut::fuzz::require;

constexpr std::array kLabels{frame::Label::kGround, frame::Label::kObstacle};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, std::string_view text) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  const auto standing = fs::status(path, error).type();
  if (standing != fs::file_type::regular && standing != fs::file_type::not_found) return;
  std::ofstream(path, std::ios::binary) << text;
}

/// A fleet of two drives, "good" and "bad/one", and its folder of labels beside what is nobody's
/// business.
class Fleet {
 public:
  Fleet() : root_("/dev/shm/terracut_labelled_folders_fuzz_" + std::to_string(::getpid())) {
    fs::remove_all(root_);
    write(root_ / "outside/notes.txt", "mine");
    write(root_ / "outside/000000.label", "mine");
    write(good_.capture = root_ / "in/good.pcap", "packets");
    write(bad_.capture = root_ / "in/bad.pcap", "packets");
    good_.name = "good";
    bad_.name = "bad/one";
    job_ = {.folder = root_ / "out",
            .manifest = root_ / "in/fleet.json",
            .id = "0123456789abcdef",
            .program = "p",
            .settings = "input:\n  reorder_packets: 3\n",
            .host = "host"};
    fs::create_directories(job_.parts());
    fs::create_directories(job_.state());
    const std::string name = cli::output_name_of(bad_, *cli::recipe_of(job_, bad_));
    const fs::path labelled = job_.folder / name;
    const auto record_of = [&](const char* drive, const char* last_name) {
      return job_.state() / "records" /
             (std::string(last_name) + "-" + cli::short_hash(drive) + ".json");
    };
    places_ = {bad_.capture,
               job_.state() / "job.json",
               job_.state() / "terracut.yaml",
               record_of("good", "good"),
               record_of("bad/one", "one"),
               labelled,
               labelled / "000000.label",
               labelled / "000001.label",
               labelled / cli::kDriveFacts,
               labelled / cli::kDriveSums,
               labelled / "terracut.yaml",
               labelled / "notes.txt",
               job_.folder / "bad",
               job_.broken(),
               job_.parts() / (job_.part_prefix(bad_) + "host.part-7-7"),
               root_ / "plain",
               root_ / "plain/000000.label",
               root_ / "plain/.label.terracut",
               root_ / "plain/a\x1b[2Jb\n.label",
               root_ / "plain/below/000000.label"};
    targets_ = {root_ / "outside/notes.txt", root_ / "outside", root_ / "outside/000000.label",
                root_ / "nowhere",           "/dev/zero",       job_.folder};
    phrases_ = {
        R"({"manifest": "m", "terracut": "1", "began_ns": 1, "drives": [{"name": "good", )"
        R"("bytes": 7}, {"name": "bad/one", "bytes": 18446744073709551615}]})",
        R"({"drive": "bad/one", "state": "done", "output": ")" + name +
            R"(", "frames": 2, "label_bytes": 9, "seconds": 1e308, "started_ns": 1, )"
            R"("ended_ns": 9223372036854775807, "stamps": {}})",
        R"({"drive": "bad/one", "state": "failed", "cause": "\u001b]0;", "message": "\r"})",
        R"({"drive": "bad/one", "files": 1, "bytes": 8, "frames": 1})",
        std::string(64, '0') + "  000000.label\n" + std::string(64, '1') + "  terracut.json\n",
        std::string("\x28\0\0\0\x63\0\0\0", 8),
        "of: /elsewhere\n000000.label\nnotes.txt\n../outside/000000.label\n",
        "input:\n  reorder_packets: 3\n"};
  }

  ~Fleet() {
    std::error_code gone_or_not;
    fs::remove_all(root_, gone_or_not);
  }
  Fleet(const Fleet&) = delete;
  Fleet& operator=(const Fleet&) = delete;

  void run(fuzz::Input& input) {
    constexpr int kMostSteps = 64, kMostShards = 1;
    int shards = 0;
    for (int step = 0; step < kMostSteps && !input.empty(); ++step) {
      const std::uint32_t what = input.next(1) & 15;
      const fs::path& place = places_[static_cast<std::size_t>(input.below(20))];
      switch (what) {
        case 6:
          look();
          break;
        case 7:
          compare(place);
          break;
        case 8:
        case 9:
          write_frames(place, what == 9);
          break;
        case 10:
          put(place);
          break;
        case 15:
          if (++shards <= kMostShards) label();
          break;
        default:
          // By a link to what is outside, others could write there themselves.
          if (lies_inside(place)) disturb(what, place, input);
      }
    }
    look();
    check_outside();
  }

 private:
  [[nodiscard]] bool lies_inside(const fs::path& place) const {
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(place.parent_path(), error);
    if (error || fs::is_symlink(place, error)) return false;
    const fs::path below = folder.lexically_relative(root_);
    return !below.empty() && *below.begin() != ".." && *below.begin() != "outside";
  }

  void disturb(std::uint32_t what, const fs::path& place, fuzz::Input& input) const {
    std::error_code error;
    fs::create_directories(place.parent_path(), error);
    switch (what) {
      case 0:
        write(place, phrases_[static_cast<std::size_t>(input.below(8))]);
        break;
      case 1: {
        const auto bytes = input.take(input.next(1));
        write(place, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        break;
      }
      case 2:
        fs::create_symlink(targets_[static_cast<std::size_t>(input.below(6))], place, error);
        break;
      case 3:
        (void)::mkfifo(place.c_str(), 0600);
        break;
      case 4:
        fs::create_directories(place, error);
        break;
      default:
        fs::remove_all(place, error);
    }
  }

  void look() const {
    const auto status = cli::relabel_status(job_.folder);
    if (!status) return;
    require(*status == cli::for_terminal(*status), "what is said moves the cursor");
    for (const auto& [name, sum] : cli::listed_sums(places_[5])) {
      require(name.find('/') == std::string::npos, "a sum of a file elsewhere");
    }
    const auto facts = cli::facts_of_whole(places_[5]);
    if (facts.is_null()) return;
    cli::RelabelRecord record;
    cli::take_facts(facts, record);
  }

  void compare(const fs::path& place) const {
    const auto before = cli::find_labelling(job_.folder);
    const auto after = cli::find_labelling(place);
    const auto plain = cli::find_labelling(root_ / "plain");
    for (const auto& [a, b] : {std::pair{&before, &after}, std::pair{&after, &plain}}) {
      if (!*a || !*b) continue;
      for (const bool trusts : {false, true}) {
        const auto changes = cli::compare_labels(**a, **b, 2, trusts);
        if (!changes) continue;
        const std::string text = changes->text(2);
        require(text == cli::for_terminal(text), "what is said moves the cursor");
      }
    }
  }

  /// As `replay --labels` does.
  static void write_frames(const fs::path& folder, bool overwrites) {
    output::FrameFolder frames({.folder = folder,
                                .ending = ".label",
                                .made_of = "/in/good.pcap",
                                .replaces_others = overwrites});
    if (!frames.check()) return;
    for (const char* const name : {"000000.label", "000002.label"}) {
      const auto path = frames.place(name);
      if (path) (void)output::write_label_file(*path, kLabels);
    }
  }

  void put(const fs::path& place) const {
    const fs::path made = root_ / "made";
    std::error_code error;
    fs::remove_all(made, error);
    write(made / "000000.label", phrases_[5]);
    require(cli::seal(made, {{"drive", "bad/one"}}).has_value());
    (void)cli::put_in_place(made, place, job_.broken() / "x");
  }

  void label() const {
    const cli::HeardLines heard;
    const std::array drives{bad_, good_};
    const cli::ExitCode code =
        cli::ShardRun(job_, "1/1").run(std::vector<cli::FleetDrive>(drives.begin(), drives.end()));
    for (const auto* const lines : {&heard.said, &heard.warned}) {
      for (const std::string& line : *lines) {
        require(line == cli::for_terminal(line), "what is said moves the cursor");
      }
    }
    const std::string name = cli::output_name_of(good_, *cli::recipe_of(job_, good_));
    require(!cli::facts_of_whole(job_.folder / name).is_null(),
            code == cli::kOk ? "no labels of the good drive" : "a bad drive cost a good one");
  }

  void check_outside() const {
    for (const char* const name : {"notes.txt", "000000.label"}) {
      require(content_of(root_ / "outside" / name) == "mine", "somebody's file was touched");
    }
  }

  fs::path root_;
  cli::FleetDrive good_, bad_;
  cli::RelabelJob job_;
  std::vector<fs::path> places_, targets_;
  std::vector<std::string> phrases_;
};

/// Stands in for the program that labels a drive: a shard starts itself for that.
[[noreturn]] void label_drive(int argc, char** argv) {
  fs::path labels, report, capture;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--labels") == 0) labels = argv[i + 1];
    if (std::strcmp(argv[i], "--json") == 0) report = argv[i + 1];
    if (std::strcmp(argv[i], "replay") == 0) capture = argv[i + 1];
  }
  if (content_of(capture) != "packets") {
    std::fputs("error: no packets\x1b[2J\n", stderr);
    ::_exit(cli::kInputRefused);
  }
  write(labels / "000000.label", std::string_view("\x28\0\0\0", 4));
  write(report, R"({"summary": {"frames": 1, "returns_labelled": 1, "losses": {}}})");
  ::_exit(cli::kOk);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (std::strcmp((*argv)[0], "terracut") == 0) label_drive(*argc, *argv);
  // What a shard prints is not looked at.
  if (std::freopen("/dev/null", "w", stdout) == nullptr) return 1;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  Fleet().run(input);
  return 0;
}
