#pragma once

#include <tests/support/fake_loader.hpp>

namespace nearfield::test_support {

/// Lies that give the host a cache of its own before each mapped memory, as on devices without
/// coherent memory. What the host writes reaches the device when it is flushed, what the device
/// writes reaches the host when it is invalidated; until then the host reads what its cache held,
/// at first junk. One at a time, as with FakeLoader.
[[nodiscard]] Lies incoherent_memory();

}  // namespace nearfield::test_support
