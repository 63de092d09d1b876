// A test is a function; a check that fails says where, and the run goes on.
#pragma once

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace check {

struct Test {
    const char *name;
    void (*run)();
};

inline std::vector<Test> tests;
inline int n_checks = 0, n_failed = 0;

struct Registered {
    Registered(const char *name, void (*run)()) { tests.push_back({name, run}); }
};

inline void that(bool holds, const char *what, const char *file, int line) {
    ++n_checks;
    if (holds) return;
    ++n_failed;
    std::printf("%s:%d: %s\n", file, line, what);
}

}  // namespace check

#define TEST(name)                                               \
    static void name();                                          \
    static const check::Registered registered_##name(#name, name); \
    static void name()
#define CHECK(...) check::that((__VA_ARGS__), #__VA_ARGS__, __FILE__, __LINE__)
#define CHECK_NEAR(a, b, most) CHECK(std::abs((a) - (b)) <= (most))
