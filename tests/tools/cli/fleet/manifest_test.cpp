// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/fleet/manifest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"
#include "tools/cli/fleet/drive_search.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class FleetManifest : public test::InScratchFolder {
 protected:
  void write(const std::string& name, const std::string& content = "x") const {
    InScratchFolder::write(name, content);
  }
  [[nodiscard]] Expected<Manifest> read(const std::string& content) const {
    write("m.json", content);
    return read_manifest(folder_ / "m.json");
  }
  [[nodiscard]] std::map<std::string, FleetDrive> found() const {
    std::map<std::string, FleetDrive> drives;
    const auto manifest = find_drives(folder_);
    EXPECT_TRUE(manifest) << manifest.error().message;
    if (!manifest) return drives;
    for (const FleetDrive& drive : manifest->drives) drives.emplace(drive.name, drive);
    return drives;
  }
};

TEST_F(FleetManifest, FindsCapturesAndScansAtAnyDepth) {
  write("a.pcap", "12345");
  write("day/b.pcapng");
  write("day/kitti/velodyne/000000.bin", "123");
  write("day/kitti/velodyne/000001.bin", "1234");
  write("day/clouds/1.ply");
  write("day/notes.txt");
  write(".hidden/c.pcap");
  const auto drives = found();
  ASSERT_EQ(drives.size(), 4U);
  EXPECT_EQ(drives.at("a").capture, folder_ / "a.pcap");
  EXPECT_EQ(drives.at("a").bytes, 5U);
  EXPECT_EQ(drives.at("day/b").capture, folder_ / "day/b.pcapng");
  EXPECT_EQ(drives.at("day/kitti").scans, folder_ / "day/kitti");
  EXPECT_EQ(drives.at("day/kitti").bytes, 7U);
  EXPECT_EQ(drives.at("day/clouds").scans, folder_ / "day/clouds");
}

TEST_F(FleetManifest, TellsCapturesOfOneNameApart) {
  write("a.pcap");
  write("a.pcapng");
  const auto drives = found();
  EXPECT_TRUE(drives.contains("a.pcap"));
  EXPECT_TRUE(drives.contains("a.pcapng"));
}

TEST_F(FleetManifest, TakesEverythingThatLooksLikeACapture) {
  for (const char* const name : {"drive.pcap", "drive.pcap1", "drive.pcap02", "OLD.PCAP",
                                 "wire.cap", "rotated.pcap.1", "dated.pcapng-20261103"}) {
    write(name);
  }
  write("by_bytes", std::string("\xd4\xc3\xb2\xa1\x02\x00\x04\x00", 8));
  write("by_bytes.dump", std::string("\x0a\x0d\x0d\x0a\x1c\x00\x00\x00\x4d\x3c\x2b\x1a", 12));
  write("text.dump");
  write("drive.calibration.xml");
  std::vector<std::string> names;
  for (const auto& [name, drive] : found()) {
    names.push_back(name);
    EXPECT_EQ(drive.capture.filename().string().substr(0, name.size()), name);
    EXPECT_EQ(drive.calibration.empty(), !name.starts_with("drive")) << name;
  }
  EXPECT_THAT(names, ElementsAre("OLD", "by_bytes", "by_bytes.dump", "dated", "drive.pcap",
                                 "drive.pcap02", "drive.pcap1", "rotated", "wire"));
}

TEST_F(FleetManifest, NamesWhatLooksLikeARecordingAndIsNotTaken) {
  write("a.pcap");
  write("b.pcap.gz", "\x1f\x8b\x08");
  write("c.PCAP2.zst", "\x28\xb5\x2f\xfd");
  write("clouds/000000.bin.gz", "\x1f\x8b\x08");
  write("bag.bag", "#ROSBAG V2.0");
  write("M\xe4rz.pcap");
  write("M\xe4rz/1.pcd");
  write("notes.txt.gz", "\x1f\x8b\x08");
  fs::create_symlink("nowhere", folder_ / "moved.pcap");
  fs::create_symlink("nowhere", folder_ / "moved.txt");
  fs::create_symlink("/dev/zero", folder_ / "device.pcap");
  const auto manifest = find_drives(folder_);
  ASSERT_TRUE(manifest) << manifest.error().message;
  EXPECT_EQ(manifest->drives.size(), 1U);
  std::map<std::string, std::string> left_out;
  for (const LeftOut& each : manifest->left_out) {
    left_out[each.path.lexically_relative(folder_)] = each.why;
  }
  EXPECT_EQ(left_out.size(), 8U);
  EXPECT_THAT(left_out["b.pcap.gz"], HasSubstr("gunzip"));
  EXPECT_THAT(left_out["c.PCAP2.zst"], HasSubstr("unzstd"));
  EXPECT_THAT(left_out["clouds/000000.bin.gz"], HasSubstr("gunzip"));
  EXPECT_THAT(left_out["bag.bag"], HasSubstr("ROS bag"));
  EXPECT_THAT(left_out["M\xe4rz.pcap"], HasSubstr("UTF-8"));
  EXPECT_THAT(left_out["M\xe4rz/1.pcd"], HasSubstr("UTF-8"));
  EXPECT_THAT(left_out["moved.pcap"], HasSubstr("leads nowhere"));
  EXPECT_THAT(left_out["device.pcap"], HasSubstr("neither file nor folder"));
  ASSERT_TRUE(write_manifest(folder_ / "m.json", *manifest));
  EXPECT_TRUE(read_manifest(folder_ / "m.json"));
}

TEST_F(FleetManifest, SaysWhatThereIsWhereNoneOfItIsADrive) {
  write("b.pcap.gz", "\x1f\x8b\x08");
  EXPECT_THAT(find_drives(folder_).error().message, HasSubstr("b.pcap.gz: gzip; unpack it first"));
}

TEST_F(FleetManifest, FollowsLinksButNotInCircles) {
  write("elsewhere/sequences/01/velodyne/000000.bin");
  write("elsewhere/sequences/02/velodyne/000000.bin");
  write("tree/here/a.pcap");
  fs::create_directory_symlink("../elsewhere/sequences", folder_ / "tree/kitti");
  fs::create_directory_symlink("../elsewhere/sequences/01", folder_ / "tree/zero_one");
  fs::create_directory_symlink("here", folder_ / "tree/again");
  fs::create_directory_symlink(".", folder_ / "tree/here/self");
  fs::create_directory_symlink("../..", folder_ / "tree/here/above");
  fs::create_directory_symlink("../../tree", folder_ / "elsewhere/sequences/back");
  const auto manifest = find_drives(folder_ / "tree");
  ASSERT_TRUE(manifest) << manifest.error().message;
  std::vector<std::string> names;
  for (const FleetDrive& drive : manifest->drives) names.push_back(drive.name);
  EXPECT_THAT(names, ElementsAre("here/a", "kitti/01", "kitti/02"));
  EXPECT_EQ(manifest->drives[1].scans, folder_ / "tree/kitti/01");
  EXPECT_TRUE(manifest->left_out.empty());
}

TEST_F(FleetManifest, PassesOverWhatFileServersKeepForThemselves) {
  write("a.pcap");
  write("@eaDir/a.pcap/thumb.bin");
  write("#recycle/b.pcap");
  write("__MACOSX/c.pcap");
  write("@mine/d.pcap");
  EXPECT_EQ(found().size(), 2U);
  const auto manifest = find_drives(folder_);
  ASSERT_TRUE(write_manifest(folder_ / "m.json", *manifest));
  EXPECT_TRUE(read_manifest(folder_ / "m.json")) << "@mine";
}

TEST_F(FleetManifest, IsReadBackWhereverItsRootLies) {
  write(".hidden/000000.bin");
  const auto manifest = find_drives(folder_ / ".hidden");
  ASSERT_TRUE(manifest && write_manifest(folder_ / "m.json", *manifest));
  const auto read = read_manifest(folder_ / "m.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->drives.at(0).name, "hidden");
}

TEST_F(FleetManifest, LeavesOutAFolderThatCannotBeRead) {
  constexpr ::uid_t kNobody = 65534;
  const ::uid_t self = ::geteuid();
  write("a.pcap");
  write("closed/b.pcap");
  fs::permissions(folder_, fs::perms(0755));
  fs::permissions(folder_ / "closed", fs::perms::none);
  if (self == 0 && ::seteuid(kNobody) != 0) GTEST_SKIP() << "root reads everything";
  const auto manifest = find_drives(folder_);
  ASSERT_EQ(::seteuid(self), 0);
  fs::permissions(folder_ / "closed", fs::perms::owner_all);
  ASSERT_TRUE(manifest) << manifest.error().message;
  EXPECT_EQ(manifest->drives.size(), 1U);
  ASSERT_EQ(manifest->left_out.size(), 1U);
  EXPECT_EQ(manifest->left_out[0].path, folder_ / "closed");
  EXPECT_THAT(manifest->left_out[0].why, HasSubstr("Permission denied"));
}

TEST_F(FleetManifest, LeavesOutCloudsBesideASequence) {
  write("00/velodyne/000000.bin");
  write("00/000000.pcd");
  const auto manifest = find_drives(folder_);
  ASSERT_TRUE(manifest);
  EXPECT_EQ(manifest->drives.size(), 1U);
  ASSERT_EQ(manifest->left_out.size(), 1U);
  EXPECT_THAT(manifest->left_out[0].why, HasSubstr("velodyne"));
}

TEST_F(FleetManifest, TakesWhatHasTheDrivesNameElseTheNearestAbove) {
  write("db.xml");
  write("setup.yaml");
  write("day/vehicle.dbc");
  write("day/own.pcap");
  write("day/own.calibration.xml");
  write("day/own.setup.yaml");
  write("day/own.can.log");
  write("day/other.pcap");
  write("ruby/angle.csv");
  write("ruby/r.pcap");
  const auto drives = found();
  EXPECT_EQ(drives.at("day/own").calibration, folder_ / "day/own.calibration.xml");
  EXPECT_EQ(drives.at("day/own").setup, folder_ / "day/own.setup.yaml");
  EXPECT_EQ(drives.at("day/own").can, folder_ / "day/own.can.log");
  EXPECT_EQ(drives.at("day/own").dbc, folder_ / "day/vehicle.dbc");
  EXPECT_EQ(drives.at("day/other").calibration, folder_ / "db.xml");
  EXPECT_EQ(drives.at("day/other").setup, folder_ / "setup.yaml");
  EXPECT_EQ(drives.at("day/other").dbc, "") << "it has no recording of the bus";
  EXPECT_EQ(drives.at("ruby/r").calibration, folder_ / "ruby/angle.csv");
}

TEST_F(FleetManifest, AsksWhereTwoCalibrationsMightBeMeant) {
  write("a.pcap");
  write("db.xml");
  write("angle.csv");
  const auto manifest = find_drives(folder_);
  ASSERT_FALSE(manifest);
  EXPECT_THAT(manifest.error().message, HasSubstr("either might be meant"));
}

TEST_F(FleetManifest, RefusesACanRecordingThatNothingExplains) {
  write("a.pcap");
  write("a.can.log");
  const auto manifest = find_drives(folder_);
  ASSERT_FALSE(manifest);
  EXPECT_THAT(manifest.error().message, HasSubstr("vehicle.dbc"));
}

TEST_F(FleetManifest, SaysWhereThereIsNoDrive) {
  write("notes.txt");
  EXPECT_EQ(find_drives(folder_).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(find_drives(folder_ / "nowhere").error().code, ErrorCode::kNotFound);
}

TEST_F(FleetManifest, IsReadAsItWasWritten) {
  FleetDrive drive;
  drive.name = "day/a";
  drive.capture = folder_ / "day/a.pcap";
  drive.calibration = "/elsewhere/db.xml";
  drive.arguments = {"--port", "2368"};
  drive.bytes = 7;
  ASSERT_TRUE(write_manifest(folder_ / "sub/m.json", {folder_, {drive}}));
  const auto manifest = read_manifest(folder_ / "sub/m.json");
  ASSERT_TRUE(manifest) << manifest.error().message;
  const FleetDrive& read = manifest->drives.at(0);
  EXPECT_EQ(read.name, drive.name);
  EXPECT_EQ(read.capture, drive.capture);
  EXPECT_EQ(read.calibration, drive.calibration);
  EXPECT_EQ(read.arguments, drive.arguments);
  EXPECT_EQ(read.bytes, 7U);
}

TEST_F(FleetManifest, RefusesWhatIsNone) {
  for (const auto& [content, reason] : std::map<std::string, std::string>{
           {"", "parse error"},
           {"[]", "type_error"},
           {R"({"manifest": 2, "drives": []})", "is to be 1"},
           {R"({"manifest": 1, "drives": []})", "lists no drive"},
           {R"({"manifest": 1, "drives": [{"name": "../a", "capture": "a"}]})", "no name"},
           {R"({"manifest": 1, "drives": [{"name": "/a", "capture": "a"}]})", "no name"},
           {R"({"manifest": 1, "drives": [{"name": "a\u0000b", "capture": "a"}]})", "no name"},
           {R"({"manifest": 1, "drives": [{"name": "a", "capture": "a\u0000b"}]})", "zero byte"},
           {R"({"manifest": 1, "drives": [{"name": "a", "capture": "a", )"
            R"("arguments": ["\u0000"]}]})",
            "zero byte"},
           {R"({"manifest": 1, "drives": [3]})", "whole number"},
           {R"({"manifest": 1, "drives": [{"name": "a", "capture": "a", "bytes": 1e300}]})",
            "whole number"},
           {R"({"manifest": 1, "drives": [{"name": "a"}]})", "one of capture and scans"},
           {R"({"manifest": 1, "drives": [{"name": "a", "capture": 3}]})", "type_error"},
           {R"({"manifest": 1, "drives": [{"name": "a", "capture": "a", "can": "l"}]})", "both"},
           {R"({"manifest": 1, "drives": [{"name": "a", "capture": "a"}, {"name": "a",)"
            R"( "capture": "b"}]})",
            "two drives"}}) {
    const auto manifest = read(content);
    ASSERT_FALSE(manifest) << content;
    EXPECT_EQ(manifest.error().code, ErrorCode::kMalformed);
    EXPECT_THAT(manifest.error().message, HasSubstr(reason));
  }
  EXPECT_EQ(read_manifest(folder_ / "none.json").error().code, ErrorCode::kNotFound);
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_manifest(folder_ / "pipe").error().code, ErrorCode::kUnreadable);
}

TEST(FleetShards, HoldEveryDriveOnceAndAboutTheSameBytes) {
  Manifest manifest;
  std::uint64_t all = 0, greatest = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    FleetDrive drive;
    drive.name = std::to_string(i);
    drive.bytes = 1 + i * i * 7919 % 1000;
    all += drive.bytes;
    greatest = std::max(greatest, drive.bytes);
    manifest.drives.push_back(drive);
  }
  std::map<std::string, int> seen;
  for (std::size_t i = 1; i <= 7; ++i) {
    std::uint64_t bytes = 0;
    for (const FleetDrive& drive : drives_of(manifest, {i, 7})) {
      ++seen[drive.name];
      bytes += drive.bytes;
    }
    EXPECT_NEAR(static_cast<double>(bytes), static_cast<double>(all) / 7,
                static_cast<double>(greatest));
  }
  EXPECT_EQ(seen.size(), 200U);
  EXPECT_TRUE(std::ranges::all_of(seen, [](const auto& drive) { return drive.second == 1; }));
}

TEST(FleetShards, AreEmptyWhereThereAreFewerDrives) {
  FleetDrive drive;
  drive.name = "a";  // of no bytes
  const Manifest manifest{{}, {drive}};
  std::size_t drives = 0;
  for (std::size_t i = 1; i <= 3; ++i) drives += drives_of(manifest, {i, 3}).size();
  EXPECT_EQ(drives, 1U);
}

TEST(FleetShards, BeyondAsManyAsThereAreDrivesTakeNoMemory) {
  Manifest manifest;
  for (const char* const name : {"a", "b", "c"}) {
    manifest.drives.emplace_back();
    manifest.drives.back().name = name;
  }
  const std::size_t of = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(drives_of(manifest, {2, of}).at(0).name, "b");
  EXPECT_EQ(drives_of(manifest, {4, of}).size(), 0U);
  EXPECT_EQ(drives_of(manifest, {of, of}).size(), 0U);
}

TEST(FleetShards, AreNamedFromOneOn) {
  EXPECT_EQ(parse_shard("3/12")->number, 3U);
  EXPECT_EQ(parse_shard("3/12")->of, 12U);
  for (const char* const text : {"", "3", "0/4", "5/4", "1/0", "-1/4", "1/4x", "a/b", "1/", "/4"}) {
    EXPECT_FALSE(parse_shard(text)) << text;
  }
}

}  // namespace
}  // namespace terracut::cli
