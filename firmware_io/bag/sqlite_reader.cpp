// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "firmware_io/bag/bag_file.hpp"
#include "firmware_io/bag/unpacked.hpp"

namespace terracut::bag {
namespace {

struct CloseDatabase {
  void operator()(::sqlite3* database) const noexcept { ::sqlite3_close(database); }
};
struct Finalize {
  void operator()(::sqlite3_stmt* statement) const noexcept { ::sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<::sqlite3_stmt, Finalize>;

std::string text_in(::sqlite3_stmt* statement, int column) {
  const unsigned char* const text = ::sqlite3_column_text(statement, column);
  const auto bytes = static_cast<std::size_t>(::sqlite3_column_bytes(statement, column));
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text), bytes);
}

/// Reads the tables `topics` and `messages` of rosbag2's sqlite3 storage, all versions.
class SqliteReader final : public BagFile {
 public:
  explicit SqliteReader(std::string name) : name_(std::move(name)) {}

  Status begin(const std::filesystem::path& path) {
    ::sqlite3* opened = nullptr;
    const int result = ::sqlite3_open_v2(path.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
    database_.reset(opened);
    if (result != SQLITE_OK) return refused(ErrorCode::kUnreadable);
    ::sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(kMostBytes));
    // What a database may bring along (views, virtual tables, triggers) is not run.
    ::sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    ::sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    if (Status plain = check_tables(); !plain) return plain;
    if (Status read = read_topics(); !read) return read;
    messages_ =
        statement("SELECT id, topic_id, timestamp, data FROM messages WHERE id >= ?1 ORDER BY id");
    return messages_ ? seek({}) : refused(ErrorCode::kMalformed);
  }

  [[nodiscard]] const std::vector<Topic>& topics() const noexcept override { return topics_; }

  [[nodiscard]] Expected<std::optional<Message>> next(const std::vector<bool>& wanted) override {
    if (broke_off_) return tl::unexpected(*broke_off_);
    ::sqlite3_stmt* const row = messages_.get();
    int step = SQLITE_DONE;
    while (!is_at_end_ && (step = ::sqlite3_step(row)) == SQLITE_ROW) {
      const auto topic = topic_of_.find(::sqlite3_column_int64(row, 1));
      if (topic == topic_of_.end() || topic->second >= wanted.size() || !wanted[topic->second]) {
        continue;
      }
      const void* const data = ::sqlite3_column_blob(row, 3);
      const auto bytes = static_cast<std::size_t>(::sqlite3_column_bytes(row, 3));
      if (data == nullptr && ::sqlite3_errcode(database_.get()) == SQLITE_NOMEM) {
        step = SQLITE_NOMEM;
        break;
      }
      return Message{topic->second,
                     std::max<std::int64_t>(0, ::sqlite3_column_int64(row, 2)),
                     {0, static_cast<std::uint64_t>(::sqlite3_column_int64(row, 0))},
                     {static_cast<const std::byte*>(data), data == nullptr ? 0 : bytes}};
    }
    is_at_end_ = true;
    if (step == SQLITE_DONE) return std::nullopt;
    broke_off_ =
        Error{ErrorCode::kMalformed, fmt::format("{}: breaks off: {}; what came before it is read",
                                                 name_, ::sqlite3_errmsg(database_.get()))};
    return tl::unexpected(*broke_off_);
  }

  [[nodiscard]] Status seek(Place place) override {
    broke_off_.reset();
    is_at_end_ = false;
    ::sqlite3_reset(messages_.get());
    ::sqlite3_bind_int64(messages_.get(), 1, static_cast<::sqlite3_int64>(place.item));
    return {};
  }

 private:
  tl::unexpected<Error> refused(ErrorCode code) const {
    return fail(code, fmt::format("{}: is no bag of rosbag2's that can be read: {}", name_,
                                  ::sqlite3_errmsg(database_.get())));
  }

  Statement statement(std::string_view sql) {
    ::sqlite3_stmt* made = nullptr;
    ::sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &made, nullptr);
    return Statement(made);
  }

  /// Requires tables: a view could compute for ever.
  Status check_tables() {
    const Statement tables = statement(
        "SELECT count(*) FROM sqlite_master WHERE name IN ('topics', 'messages') AND "
        "type = 'table' AND sql LIKE 'CREATE TABLE%'");
    if (!tables || ::sqlite3_step(tables.get()) != SQLITE_ROW) {
      return refused(ErrorCode::kMalformed);
    }
    if (::sqlite3_column_int(tables.get(), 0) == 2) return {};
    return fail(ErrorCode::kMalformed,
                name_ + ": is no bag of rosbag2's: expected tables topics and messages");
  }

  Status read_topics() {
    const Statement rows =
        statement("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
    if (!rows) return refused(ErrorCode::kMalformed);
    int step = SQLITE_DONE;
    while ((step = ::sqlite3_step(rows.get())) == SQLITE_ROW && topics_.size() < kMostTopics) {
      Topic topic{text_in(rows.get(), 1), text_in(rows.get(), 2)};
      const bool is_short = topic.name.size() <= kLongestName && topic.type.size() <= kLongestName;
      if (!is_short || text_in(rows.get(), 3) != "cdr") continue;
      topic_of_[::sqlite3_column_int64(rows.get(), 0)] = topics_.size();
      topics_.push_back(std::move(topic));
    }
    return step == SQLITE_DONE || step == SQLITE_ROW ? Status{} : refused(ErrorCode::kMalformed);
  }

  std::string name_;
  std::unique_ptr<::sqlite3, CloseDatabase> database_;
  Statement messages_;  ///< Declared after its database, so that it is finalized first.
  std::vector<Topic> topics_;
  std::map<std::int64_t, std::size_t> topic_of_;  ///< By the id of the topic.
  bool is_at_end_ = false;
  std::optional<Error> broke_off_;
};

}  // namespace

OpenedFile open_sqlite(const std::filesystem::path& path, std::string name) {
  auto reader = std::make_unique<SqliteReader>(std::move(name));
  if (Status begun = reader->begin(path); !begun) return tl::unexpected(begun.error());
  return reader;
}

}  // namespace terracut::bag
