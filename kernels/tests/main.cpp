// Runs all native tests of the kernels; fails if a check does.
#include <cstdio>

#include "check.hpp"

int main() {
    for (const auto &[name, run] : check::tests) {
        const int before = check::n_failed;
        run();
        if (check::n_failed > before) std::printf("FAILED %s\n", name);
    }
    std::printf("%zu tests, %d checks, %d failed\n", check::tests.size(), check::n_checks,
                check::n_failed);
    return check::n_failed == 0 && check::n_checks > 0 ? 0 : 1;
}
