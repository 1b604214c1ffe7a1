// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/request_rules.h"

#include <gtest/gtest.h>

namespace roomcut::view {
namespace {

constexpr int kPort = 8123;

RequestHead put() {
  RequestHead head;
  head.method = "PUT";
  head.host = {"127.0.0.1:8123"};
  head.origin = {"http://127.0.0.1:8123"};
  head.mark = {"1"};
  head.content_length = {"12"};
  head.content_type = {"application/geo+json"};
  return head;
}

int status(const RequestHead& head) {
  const auto refusal = refuse(head, kPort);
  return refusal ? refusal->status : 200;
}

TEST(Refuse, LetsTheOwnPageChangeAndReadThings) {
  EXPECT_EQ(status(put()), 200);
  RequestHead get;
  get.method = "GET";
  get.host = {"localhost:8123"};
  EXPECT_EQ(status(get), 200);
}

TEST(Refuse, ForeignHostsAndOrigins) {
  for (const char* host : {"", "evil.example:8123", "127.0.0.1", "127.0.0.1:81", "127.0.0.1:81234"}) {
    RequestHead head = put();
    head.host = {host};
    EXPECT_EQ(status(head), 403) << host;
  }
  for (const char* origin : {"null", "", "http://evil.example:8123", "https://127.0.0.1:8123"}) {
    RequestHead head = put();
    head.origin = {origin};
    EXPECT_EQ(status(head), 403) << origin;
  }
  RequestHead twice = put();
  twice.host.emplace_back("evil.example");
  EXPECT_EQ(status(twice), 403);
  twice = put();
  twice.host.clear();
  EXPECT_EQ(status(twice), 403);
}

TEST(Refuse, AChangeNeedsItsMarkAndAKnownMethod) {
  for (const char* method : {"PUT", "POST", "DELETE"}) {
    RequestHead head = put();
    head.method = method;
    EXPECT_EQ(status(head), 200) << method;
    head.mark.clear();
    EXPECT_EQ(status(head), 403) << method;
  }
  for (const char* method : {"OPTIONS", "PATCH", "CONNECT", "TRACE", ""}) {
    RequestHead head = put();
    head.method = method;
    EXPECT_EQ(status(head), 405) << method;
  }
}

TEST(Refuse, BodiesThatAreTooLargeOfUnknownLengthPackedOrNoJson) {
  RequestHead head = put();
  head.content_length = {std::to_string(kLargestBody)};
  EXPECT_EQ(status(head), 200);
  for (const char* length : {"16777217", "99999999999999999999999999"}) {
    head.content_length = {length};
    EXPECT_EQ(status(head), 413) << length;
  }
  for (const char* length : {"", "-1", "1e3", " 5"}) {
    head.content_length = {length};
    EXPECT_EQ(status(head), 411) << length;
  }
  head.content_length = {"5", "7"};
  EXPECT_EQ(status(head), 411);
  head.method = "POST";
  head.content_length.clear();
  EXPECT_EQ(status(head), 411);
  head = put();
  head.transfer_encoding = {"chunked"};
  EXPECT_EQ(status(head), 411);
  head = put();
  head.content_encoding = {"br"};
  EXPECT_EQ(status(head), 415);
  head = put();
  head.content_type = {"text/plain"};
  EXPECT_EQ(status(head), 415);
  head.content_type = {"Application/JSON; charset=utf-8"};
  EXPECT_EQ(status(head), 200);
}

TEST(ServedFile, ThePageItsPicturesAndTheResultsOnly) {
  EXPECT_EQ(served_file("/")->name, "report.html");
  EXPECT_EQ(served_file("/model.ply")->folder, "");
  const auto picture = served_file("/pictures/slice_0.svg");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->folder, "pictures");
  EXPECT_STREQ(picture->media_type, "image/svg+xml");
  for (const char* path :
       {"", "report.html", "/x", "/logs/ingest.json", "/pictures/", "/pictures/.a.png", "/pictures/a/b.png",
        "/pictures/../a.png", "/pictures/a.ply", "/model.ply/", "//"}) {
    EXPECT_FALSE(served_file(path)) << path;
  }
}

}  // namespace
}  // namespace roomcut::view
