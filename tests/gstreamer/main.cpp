#include <gst/gst.h>
#include <gtest/gtest.h>

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  gst_init(&count, &arguments);
  const int failed = RUN_ALL_TESTS();
  gst_deinit();  // here the tracer tells of leaks
  return failed;
}
