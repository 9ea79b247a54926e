// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut node` before a program that knows nothing of it: clouds go out by plain Cyclone DDS, in
// the layouts of drivers, and come back as `terracut segment` labels the same points. On loopback.
#include <dds/dds.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "PointCloud2.h"
#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tests/tools/cli/background_program.hpp"

namespace terracut::cli {
namespace {

using Message = sensor_msgs_msg_dds__PointCloud2_;
using Bytes = std::vector<std::uint8_t>;

/// A cloud in a program's memory.
struct OwnCloud {
  std::uint32_t height = 1, width = 0, point_step = 0;
  std::vector<std::pair<std::string, std::pair<std::uint32_t, std::uint8_t>>> fields;
  Bytes data;
};

/// A program of somebody else's: writes clouds, reads answers.
class Peer {
 public:
  explicit Peer(int domain)
      : participant_(
            dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr)) {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 5);
    writer_ = dds_create_writer(participant_, topic("rt/points_raw"), qos, nullptr);
    for (const char* name : {"points", "ground", "obstacles"}) {
      readers_[name] =
          dds_create_reader(participant_, topic(std::string("rt/terracut/") + name), qos, nullptr);
    }
    dds_delete_qos(qos);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer() { dds_delete(participant_); }

  /// Until the node hears this and is heard.
  void await_node() const {
    const auto all_matched = [&] {
      dds_publication_matched_status_t heard{};
      dds_get_publication_matched_status(writer_, &heard);
      return heard.current_count == 1 && std::ranges::all_of(readers_, [](const auto& reader) {
               dds_subscription_matched_status_t matched{};
               dds_get_subscription_matched_status(reader.second, &matched);
               return matched.current_count == 1;
             });
    };
    while (!all_matched()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  void write(const OwnCloud& cloud, std::int32_t stamp_s, std::uint32_t stamp_ns = 5) const {
    std::string frame = "lidar_top";
    std::vector<sensor_msgs_msg_dds__PointField_> fields;
    for (const auto& [name, place] : cloud.fields) {
      fields.push_back({const_cast<char*>(name.c_str()), place.first, place.second, 1});
    }
    Message message{};
    message.header = {{stamp_s, stamp_ns}, frame.data()};
    message.height = cloud.height;
    message.width = cloud.width;
    const auto count = static_cast<std::uint32_t>(fields.size());
    message.fields = {count, count, fields.data(), false};
    message.point_step = cloud.point_step;
    message.row_step = cloud.width * cloud.point_step;
    const auto bytes = static_cast<std::uint32_t>(cloud.data.size());
    message.data = {bytes, bytes, const_cast<std::uint8_t*>(cloud.data.data()), false};
    ASSERT_EQ(dds_write(writer_, &message), DDS_RETCODE_OK);
  }

  struct Answer {
    std::int32_t stamp_s = -1;
    std::uint32_t height = 0, width = 0, point_step = 0;
    std::string frame_id, last_field;
    std::uint32_t last_offset = 0;
    Bytes data;
  };
  /// Writes the cloud, and waits for the answer on a topic. Writes it again every few seconds: this
  /// side cannot see when the node has found its readers.
  [[nodiscard]] Answer answer_to(const OwnCloud& cloud, std::int32_t stamp_s,
                                 const std::string& name) const {
    const dds_entity_t reader = readers_.at(name);
    const dds_entity_t has_any = dds_create_readcondition(reader, DDS_ANY_STATE);
    const dds_entity_t waiting = dds_create_waitset(participant_);
    dds_waitset_attach(waiting, has_any, 0);
    Answer answer = take(reader);
    while (answer.stamp_s != stamp_s) {
      if (dds_waitset_wait(waiting, nullptr, 0, DDS_SECS(3)) == 0) write(cloud, stamp_s);
      answer = take(reader);
    }
    dds_delete(waiting);
    dds_delete(has_any);
    return answer;
  }

  /// Waits for any answer on a topic.
  [[nodiscard]] Answer next_answer(const std::string& name) const {
    Answer answer = take(readers_.at(name));
    while (answer.data.empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      answer = take(readers_.at(name));
    }
    return answer;
  }

 private:
  [[nodiscard]] static Answer take(dds_entity_t reader) {
    void* sample = nullptr;
    dds_sample_info_t info;
    if (dds_take(reader, &sample, &info, 1, 1) != 1) return {};
    Answer answer;
    if (info.valid_data) {
      const auto& cloud = *static_cast<const Message*>(sample);
      const auto& last = cloud.fields._buffer[cloud.fields._length - 1];
      answer = {cloud.header.stamp.sec, cloud.height, cloud.width, cloud.point_step,
                cloud.header.frame_id,  last.name,    last.offset, {}};
      answer.data.assign(cloud.data._buffer, cloud.data._buffer + cloud.data._length);
    }
    dds_return_loan(reader, &sample, 1);
    return answer;
  }
  [[nodiscard]] dds_entity_t topic(const std::string& name) const {
    return dds_create_topic(participant_, &sensor_msgs_msg_dds__PointCloud2__desc, name.c_str(),
                            nullptr, nullptr);
  }

  dds_entity_t participant_, writer_ = 0;
  std::map<std::string, dds_entity_t> readers_;
};

/// Types of PointField.
constexpr std::uint8_t kU16 = 4, kF32 = 7;

/// Points with the number of their laser, ring after ring from the top.
struct Scan {
  std::vector<scan::ScanPoint> points;
  std::uint16_t rings = 0;
  [[nodiscard]] std::size_t per_ring() const { return points.size() / rings; }
};

Scan kitti_scan() {
  return {synthetic::scan(synthetic::table()), 64};
}
/// Of a sensor whose beams start at the origin.
Scan plain_scan() {
  scan::RingTable table;
  for (int ring = 0; ring < 32; ++ring) table.push_back({beams::deg_to_rad(8.0 - ring), 0});
  return {synthetic::scan(table, {.points_per_ring = 1800}), 32};
}

template <class T>
void put(Bytes& data, std::size_t at, T value) {
  std::memcpy(&data[at], &value, sizeof(value));
}

OwnCloud cloud_of(const Scan& scan, std::uint32_t point_step, const std::string& ring_field,
                  std::uint32_t ring_at) {
  OwnCloud cloud;
  cloud.width = static_cast<std::uint32_t>(scan.points.size());
  cloud.point_step = point_step;
  cloud.fields = {{"x", {0, kF32}}, {"y", {4, kF32}}, {"z", {8, kF32}}};
  if (!ring_field.empty()) cloud.fields.push_back({ring_field, {ring_at, kU16}});
  cloud.data.resize(scan.points.size() * point_step, 0xA5);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const std::size_t at = i * point_step;
    put(cloud.data, at, scan.points[i].x_m);
    put(cloud.data, at + 4, scan.points[i].y_m);
    put(cloud.data, at + 8, scan.points[i].z_m);
    if (!ring_field.empty()) {
      put(cloud.data, at + ring_at, static_cast<std::uint16_t>(i / scan.per_ring()));
    }
  }
  return cloud;
}

class NodeInterop : public Cli {
 protected:
  static void SetUpTestSuite() {
    ::setenv("CYCLONEDDS_URI",
             "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/>"
             "</Interfaces><MaxMessageSize>65500B</MaxMessageSize><FragmentSize>63000B"
             "</FragmentSize></General><Internal><SocketReceiveBufferSize max=\"8MB\"/></Internal>"
             "</Domain></CycloneDDS>",
             1);
  }
  static constexpr const char* kMount = "--mount-height 1.73 --mount-roll 0 --mount-pitch 0";

  [[nodiscard]] std::string node_arguments() const {
    return fmt::format(
        "node --dds-domain {} --in-reliable {} --deadline 10000 --metrics off --name interop_{} "
        "--json report.json",
        domain_, kMount, ::getpid());
  }

  /// The labels that `segment` gives the points of a file in `scans/`.
  [[nodiscard]] std::vector<std::uint32_t> labels_by_segment() const {
    expect_done(fmt::format("segment scans {} --labels labels", kMount));
    return ids_of(folder_ / "labels" / "000000.label");
  }
  void write_bin(const Scan& scan) const {
    fs::create_directories(folder_ / "scans");
    std::string bytes(scan.points.size() * 16, '\0');
    std::memcpy(bytes.data(), scan.points.data(), bytes.size());
    write("scans/000000.bin", bytes);
  }
  void write_pcd(const Scan& scan, bool organised) const {
    fs::create_directories(folder_ / "scans");
    std::string text = fmt::format(
        "VERSION .7\nFIELDS x y z{0}\nSIZE 4 4 4{1}\nTYPE F F F{2}\nCOUNT 1 1 1{3}\nWIDTH {4}\n"
        "HEIGHT {5}\nPOINTS {6}\nDATA ascii\n",
        organised ? "" : " ring", organised ? "" : " 2", organised ? "" : " U",
        organised ? "" : " 1", organised ? scan.per_ring() : scan.points.size(),
        organised ? scan.rings : 1, scan.points.size());
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      text += fmt::format("{:.9g} {:.9g} {:.9g}", scan.points[i].x_m, scan.points[i].y_m,
                          scan.points[i].z_m);
      text += organised ? "\n" : fmt::format(" {}\n", i / scan.per_ring());
    }
    write("scans/000000.pcd", text);
  }

  /// A cloud, and then the same again, come back with these labels.
  void expect_answers(const OwnCloud& cloud, const std::vector<std::uint32_t>& expected) const {
    ASSERT_EQ(expected.size(), std::size_t{cloud.width} * cloud.height);
    BackgroundProgram node(folder_, "node", node_arguments());
    const Peer peer(domain_);
    peer.await_node();
    for (const std::int32_t stamp_s : {7, 8}) {
      peer.write(cloud, stamp_s);
      const auto answer = [&](const char* name) { return peer.answer_to(cloud, stamp_s, name); };
      expect_labelled(answer("points"), cloud, expected);
      expect_chosen(answer("ground"), cloud, expected, 40);
      expect_chosen(answer("obstacles"), cloud, expected, 99);
    }
    node.interrupt();
    const Outcome ended = node.end();
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
    EXPECT_GE(json("report.json")["frames"]["count"], 2);
  }

  static void expect_labelled(const Peer::Answer& answer, const OwnCloud& cloud,
                              const std::vector<std::uint32_t>& expected) {
    EXPECT_EQ(answer.frame_id, "lidar_top");
    EXPECT_EQ(answer.height, cloud.height);
    EXPECT_EQ(answer.width, cloud.width);
    EXPECT_EQ(answer.last_field, "label");
    EXPECT_EQ(answer.last_offset, cloud.point_step);
    ASSERT_EQ(answer.data.size(), expected.size() * answer.point_step);
    std::vector<std::uint32_t> labels;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const std::uint8_t* point = &answer.data[i * answer.point_step];
      labels.push_back(point[answer.last_offset]);
      ASSERT_EQ(std::memcmp(point, &cloud.data[i * cloud.point_step], cloud.point_step), 0);
    }
    EXPECT_TRUE(labels == expected);
  }

  static void expect_chosen(const Peer::Answer& answer, const OwnCloud& cloud,
                            const std::vector<std::uint32_t>& expected, std::uint32_t label) {
    Bytes chosen;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (expected[i] != label) continue;
      const auto point = std::span(cloud.data).subspan(i * cloud.point_step, cloud.point_step);
      chosen.insert(chosen.end(), point.begin(), point.end());
    }
    EXPECT_FALSE(chosen.empty());
    EXPECT_EQ(answer.point_step, cloud.point_step);
    EXPECT_EQ(answer.height, 1U);
    EXPECT_TRUE(answer.data == chosen);
  }

  const int domain_ = 1 + static_cast<int>(::getpid() % 200);
};

TEST_F(NodeInterop, CloudsInKittisLayoutComeBackAsSegmentLabelsThem) {
  const Scan scan = kitti_scan();
  write_bin(scan);
  OwnCloud cloud = cloud_of(scan, 16, "", 0);
  cloud.fields.push_back({"intensity", {12, kF32}});
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    put(cloud.data, i * 16 + 12, scan.points[i].remission);
  }
  expect_answers(cloud, labels_by_segment());
}

TEST_F(NodeInterop, OrganisedCloudsInOustersLayoutComeBackAsSegmentLabelsThem) {
  Scan scan = plain_scan();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  scan.points[5] = scan.points[4321] = {kNan, kNan, kNan, 0};  // beams without a return
  write_pcd(scan, true);
  OwnCloud cloud = cloud_of(scan, 48, "", 0);
  cloud.height = scan.rings;
  cloud.width /= cloud.height;
  cloud.fields.push_back({"reflectivity", {24, kU16}});
  expect_answers(cloud, labels_by_segment());
}

TEST_F(NodeInterop, CloudsInAutowaresLayoutComeBackAsSegmentLabelsThem) {
  const Scan scan = plain_scan();
  write_pcd(scan, false);
  OwnCloud cloud = cloud_of(scan, 32, "channel", 14);  // PointXYZIRCAEDT
  for (const auto& [name, at] :
       {std::pair{"azimuth", 16U}, {"elevation", 20U}, {"distance", 24U}}) {
    cloud.fields.push_back({name, {at, kF32}});
  }
  expect_answers(cloud, labels_by_segment());
}

TEST_F(NodeInterop, CloudsThatNeverCameAreCountedByTheGapsInTheirStamps) {
  const OwnCloud cloud = cloud_of(plain_scan(), 16, "ring", 12);
  BackgroundProgram node(folder_, "node", node_arguments());
  const Peer peer(domain_);
  peer.await_node();
  // As many as a history keeps: none is lost on its way, however long the node takes.
  for (const std::uint32_t tenth : {0U, 1U, 2U, 3U, 6U}) {
    peer.write(cloud, 100, tenth * 100'000'000 + 5);
  }
  (void)peer.answer_to(cloud, 100, "points");
  peer.write(cloud, 200);
  (void)peer.answer_to(cloud, 200, "points");
  node.interrupt();
  const Outcome ended = node.end();
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_EQ(json("report.json")["losses"]["lost_clouds"], 2);
}

TEST_F(NodeInterop, CapturesAreReplayedAsADriverWouldSendThem) {
  BackgroundProgram node(folder_, "node",
                         fmt::format("node --dds-domain {} --dds-interface lo --deadline 10000 "
                                     "--base-frame off --metrics off --name raw_{} "
                                     "--json report.json",
                                     domain_, ::getpid()));
  ASSERT_TRUE(node.says("are answered on"));
  BackgroundProgram driver(
      folder_, "driver",
      fmt::format("replay {} --calibration {} --mount-height 1.73 --mount-roll 0 --mount-pitch 0 "
                  "--rate 1 --loop --dds --raw --dds-domain {} --dds-interface lo",
                  quoted(kDrive), quoted(kDriveCalibration), domain_));
  EXPECT_TRUE(driver.says("/points_raw"));
  EXPECT_TRUE(node.says("a cloud is read and labelled in")) << "twenty clouds are labelled";
  driver.interrupt();
  (void)driver.end();
  node.interrupt();
  const Outcome ended = node.end();
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.err, testing::HasSubstr("64 rows by the field of the laser's number"));
  const nlohmann::json report = json("report.json");
  EXPECT_GE(report["frames"]["count"], 20);
  EXPECT_NEAR(report["mount"]["height_m"], 1.73, 0.05) << "points are in the sensor's frame";
  EXPECT_EQ(report["mount"]["contradicted"], false);
  for (const auto& [cause, count] : report["losses"].items()) {
    if (cause.starts_with("refused_clouds")) {
      EXPECT_EQ(count, 0) << cause;
    }
  }
}

TEST_F(NodeInterop, TransformsSayHowTheSensorStandsAndWhereAnswersLie) {
  BackgroundProgram node(
      folder_, "node",
      fmt::format("node --dds-domain {} --dds-interface lo --deadline 10000 --metrics off "
                  "--frame terracut_ground --name frame_{} --json report.json",
                  domain_, ::getpid()));
  const Peer peer(domain_);
  peer.await_node();
  // 0.04 m more than it is, so that the ground would say something else.
  BackgroundProgram driver(
      folder_, "driver",
      fmt::format("replay {} --calibration {} --mount-height 1.77 --mount-roll 0 --mount-pitch 0 "
                  "--rate 1 --loop --dds --raw --dds-domain {} --dds-interface lo",
                  quoted(kDrive), quoted(kDriveCalibration), domain_));
  const Peer::Answer ground = peer.next_answer("ground");
  driver.interrupt();
  (void)driver.end();
  node.interrupt();
  const Outcome ended = node.end();
  EXPECT_THAT(ended.err, testing::HasSubstr("terracut_lidar stands 1.770 m above terracut_ground"));
  EXPECT_NEAR(json("report.json")["mount"]["height_m"], 1.77, 1e-6);
  EXPECT_EQ(ground.frame_id, "terracut_ground");
  std::vector<float> heights_m;
  for (std::size_t at = 0; at < ground.data.size(); at += ground.point_step) {
    float z_m = 0;
    std::memcpy(&z_m, &ground.data[at + 8], sizeof z_m);
    heights_m.push_back(z_m);
  }
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::ranges::nth_element(heights_m, middle);
  EXPECT_NEAR(*middle, 0.04, 0.1) << "not 1.73 m below the sensor";
}

TEST_F(NodeInterop, ACloudWhoseFrameNothingJoinsWithThatOfTheAnswersIsRefused) {
  const OwnCloud cloud = cloud_of(plain_scan(), 16, "ring", 12);
  BackgroundProgram node(folder_, "node", node_arguments() + " --frame base_link");
  const Peer peer(domain_);
  peer.await_node();
  peer.write(cloud, 1);
  EXPECT_TRUE(node.says("does not join their frame 'lidar_top' with 'base_link'"));
  node.interrupt();
  (void)node.end();
  EXPECT_EQ(json("report.json")["losses"]["refused_clouds_no_transform"], 1);
}

TEST_F(NodeInterop, CloudsThatAreNotWhatTheySayAreRefusedByNameAndGoodOnesAnsweredAllTheSame) {
  const OwnCloud good = cloud_of(plain_scan(), 16, "ring", 12);
  std::map<std::string, OwnCloud> bad;
  for (const char* cause : {"wrong_sizes", "field_beyond_point", "unknown_type", "no_points",
                            "no_position", "laser_number", "no_place"}) {
    bad[cause] = good;
  }
  bad["wrong_sizes"].height = 2;
  bad["field_beyond_point"].fields[3].second.first = 4'000'000'000;
  bad["unknown_type"].fields[3].second.second = 77;
  bad["no_points"].width = 0;
  bad["no_points"].data.clear();
  bad["no_position"].fields[2].first = "height";
  bad["laser_number"].fields[3].second = {0, kF32};
  for (std::size_t i = 0; i < bad["no_place"].width; ++i) {
    put(bad["no_place"].data, i * 16, std::numeric_limits<float>::quiet_NaN());
  }
  BackgroundProgram node(folder_, "node", node_arguments());
  const Peer peer(domain_);
  peer.await_node();
  std::int32_t stamp_s = 1;
  peer.write(good, stamp_s);
  (void)peer.answer_to(good, stamp_s, "points");  // it hears and is heard
  // Each is followed by a good one, whose answer shows that the node lives and is done with it.
  for (const auto& [cause, cloud] : bad) {
    peer.write(cloud, ++stamp_s);
    peer.write(good, ++stamp_s);
    EXPECT_EQ(peer.answer_to(good, stamp_s, "points").point_step, 20U) << cause;
  }
  node.interrupt();
  const Outcome ended = node.end();
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  const nlohmann::json report = json("report.json");
  EXPECT_GT(report["frames"]["count"], bad.size());
  for (const auto& [cause, cloud] : bad) {
    EXPECT_EQ(report["losses"]["refused_clouds_" + cause], 1) << cause;
  }
}

}  // namespace
}  // namespace terracut::cli
