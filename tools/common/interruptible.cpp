#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <string>

namespace nearfield::tools {
namespace {

std::atomic<bool> ctrl_c = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // for the signal handler

}  // namespace

void catch_ctrl_c() {
    struct sigaction action = {};
    action.sa_handler = [](int) { ctrl_c = true; };
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
}

bool was_ctrl_c_pressed() noexcept {
    return ctrl_c;
}

void stop_after_ctrl_c() {
    if (ctrl_c) {
        throw LibraryError(Status(StatusCode::cancelled), "stopped by Ctrl-C");
    }
}

InterruptibleCalls::InterruptibleCalls(const char* name) : name_(name) {
    limits_.cancel = &ctrl_c;
    if (isatty(STDERR_FILENO) == 1) {
        limits_.user = this;
        limits_.progress = [](void* user, const Progress& progress) {
            auto& calls = *static_cast<InterruptibleCalls*>(user);
            calls.done_.store(progress.done, std::memory_order_relaxed);
            calls.count_.store(progress.count, std::memory_order_relaxed);
        };
        thread_ = std::thread([this] { show_until_done(); });
    }
}

InterruptibleCalls::~InterruptibleCalls() {
    if (thread_.joinable()) {
        {
            const std::lock_guard lock(mutex_);
            is_over_ = true;
        }
        ended_.notify_one();
        thread_.join();
    }
}

void InterruptibleCalls::show_until_done() {
    using namespace std::chrono_literals;
    std::unique_lock lock(mutex_);
    const auto is_over = [this] { return is_over_; };
    if (ended_.wait_for(lock, 1s, is_over)) {
        return;
    }
    do {
        const auto passed = std::chrono::steady_clock::now() - start_;
        std::cerr << done_ << " of " << count_ << ' ' << name_ << ", "
                  << std::chrono::duration_cast<std::chrono::seconds>(passed).count()
                  << (ctrl_c ? " s; stopping\x1b[K\r" : " s; Ctrl-C stops\x1b[K\r") << std::flush;
    } while (!ended_.wait_for(lock, 200ms, is_over));
    std::cerr << "\x1b[K" << std::flush;
}

StatusLine::StatusLine() : is_shown_(isatty(STDERR_FILENO) == 1) {}

void StatusLine::show(std::string_view text) const {
    if (is_shown_) {
        std::cerr << "\r\x1b[K" << text << std::flush;
    }
}

void StatusLine::show(std::string_view what, std::uint64_t number, std::uint64_t count,
                      std::string_view name) const {
    show(std::string(what) + ' ' + std::to_string(number) + " of " + std::to_string(count) +
         (name.empty() ? "" : ": ") + std::string(name));
}

}  // namespace nearfield::tools
