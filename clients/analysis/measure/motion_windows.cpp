#include "clients/analysis/measure/motion_windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "clients/analysis/vector/clones.hpp"
#include "clients/analysis/vector/lanes.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::size_t kLeastSteps = 8;
constexpr std::size_t kSteps = MotionWindows::kBlock;
constexpr IntLanes kEachLane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// Moves the first step of the window that ends with `newest` as late as possible. Returns false if there is no window
/// yet.
[[gnu::always_inline]] inline bool narrow(const std::int32_t* past, std::size_t& first, std::int32_t least,
                                          std::size_t newest) {
    if (newest < kLeastSteps) { return false; }
    const std::size_t most = newest - kLeastSteps;  // the latest step with which a window may begin
    const std::int32_t latest = past[newest] - least;
    if (first > most || past[first] > latest) { return false; }
    while (first < most && past[first + 1] <= latest) { ++first; }
    return true;
}

/// Finds windows of almost equally many steps, without branches, which would be mispredicted. `first` is the begin of
/// the first one. Returns false if they have other numbers of steps.
[[gnu::always_inline]] inline bool narrow_near(const std::int32_t* past, std::size_t first, std::int32_t least,
                                               std::size_t from, IntLanes& begins) {
    constexpr std::int32_t kNear = 3;  // steps more or fewer
    if (first < kNear) { return false; }
    IntLanes until;
    IntLanes place;
    load(until, past + from);
    until -= least;
    const IntLanes latest = kEachLane + static_cast<std::int32_t>(from - kLeastSteps);
    load(place, past + from - kLeastSteps);
    if (all_true(place <= until)) {
        begins = latest;
        return true;
    }
    const std::int32_t* const longest = past + first - kNear;
    IntLanes fit{};
    for (std::int32_t k = 0; k <= 2 * kNear; ++k) {
        load(place, longest + k);
        fit -= place <= until;
    }
    load(place, longest + 2 * kNear + 1);
    const IntLanes begin = kEachLane + fit + static_cast<std::int32_t>(first - kNear - 1);
    begins = begin < latest ? begin : latest;
    return all_true(fit > 0) && all_true(place > until);
}

/// narrow() for each step of the block at `from`.
[[gnu::always_inline]] inline void narrow_all(const std::int32_t* past, std::size_t& first, std::int32_t least,
                                              std::size_t from, IntLanes& begins) {
    (void)narrow(past, first, least, from);
    if (!narrow_near(past, first, least, from, begins)) {
        begins[0] = static_cast<std::int32_t>(first);
        for (std::size_t i = 1; i < kSteps; ++i) {
            (void)narrow(past, first, least, from + i);
            begins[i] = static_cast<std::int32_t>(first);
        }
    }
    first = static_cast<std::size_t>(begins[kSteps - 1]);
}

/// Stores signed values and their range.
[[gnu::always_inline]] inline void store_values(const DoubleLanes& first, const DoubleLanes& second, double sign,
                                                SampleBlock& to) {
    const DoubleLanes a = sign * first;
    const DoubleLanes b = sign * second;
    store(a, to.value.data());
    store(b, to.value.data() + kSteps / 2);
    to.lowest = lowest_of(b < a ? b : a);
    to.highest = highest_of(b > a ? b : a);
}

}  // namespace

void MotionWindows::clear() {
    past_.clear();
    window_from_.clear();
    window_speed_.clear();
    windows_from_ = kNone;
    speed_first_ = late_first_ = 0;
}

void MotionWindows::forget() {
    const std::size_t gone = std::min(speed_first_, late_first_);
    const std::int32_t passed = past_[gone];
    past_.erase(past_.begin(), past_.begin() + static_cast<std::ptrdiff_t>(gone));
    window_from_.erase(window_from_.begin(), window_from_.begin() + static_cast<std::ptrdiff_t>(gone));
    window_speed_.erase(window_speed_.begin(), window_speed_.begin() + static_cast<std::ptrdiff_t>(gone));
    base_ += Ticks{passed};
    for (std::int32_t& tick : past_) { tick -= passed; }
    for (std::int32_t& tick : window_from_) { tick -= passed; }
    if (windows_from_ != kNone) { windows_from_ -= std::min(windows_from_, gone); }
    speed_first_ -= gone;
    late_first_ -= gone;
    room_ = std::max(kMostAdded, 2 * past_.size());
}

void MotionWindows::add(Tick tick) {
    if (past_.empty()) { base_ = tick; }
    past_.push_back(static_cast<std::int32_t>((tick - base_).value));
    window_from_.push_back(0);
    window_speed_.push_back(0);
}

void MotionWindows::add(const StepSpan& steps) {
    const std::size_t before = past_.size();
    past_.resize(before + steps.size());
    window_from_.resize(past_.size());
    window_speed_.resize(past_.size());
    const auto later = static_cast<std::int32_t>((steps.origin() - base_).value);
    const std::int32_t* const ticks = steps.ticks();
    for (std::size_t i = 0; i < steps.size(); ++i) { past_[before + i] = later + ticks[i]; }
}

std::optional<Sample> MotionWindows::speed() {
    const std::size_t newest = size() - 1;
    if (!narrow(past_.data(), speed_first_, kSpeedWindow, newest)) { return std::nullopt; }
    const std::int32_t first = past_[speed_first_];
    return Sample{base_ + Ticks{first + (past_[newest] - first) / 2}, speed_since(speed_first_)};
}

/// The later window ends with the newest step. The earlier window ends with the first step of the later one. The time
/// between their middles is half of both together.
std::optional<Sample> MotionWindows::acceleration() {
    const std::size_t newest = size() - 1;
    if (!narrow(past_.data(), late_first_, kAccelerationWindow, newest)) { return std::nullopt; }
    windows_from_ = std::min(windows_from_, newest);
    window_from_[newest] = past_[late_first_];
    window_speed_[newest] = speed_since(late_first_);
    if (late_first_ < windows_from_) { return std::nullopt; }
    const double ticks = 0.5 * (past_[newest] - window_from_[late_first_]);
    return Sample{tick(late_first_), (window_speed_[newest] - window_speed_[late_first_]) / ticks};
}

LOCKSTEP_VECTOR_CLONES
void MotionWindows::measure(std::size_t from, double sign, Block& measured, StepRates* rates) {
    const std::int32_t* const past = past_.data();
    measured.speed.origin = measured.acceleration.origin = base_;
    IntLanes newest;
    load(newest, past + from);
    const IntLanes numbers = kEachLane + static_cast<std::int32_t>(from);

    IntLanes begins;
    IntLanes first;
    narrow_all(past, speed_first_, kSpeedWindow, from, begins);
    pick(past, size(), begins, first);
    IntLanes ticks = newest - first;
    store(first + ticks / 2, measured.speed.at.data());
    DoubleLanes speed[2];
    divide(numbers - begins, ticks, speed[0], speed[1]);
    store_values(speed[0], speed[1], sign, measured.speed);

    narrow_all(past, late_first_, kAccelerationWindow, from, begins);
    pick(past, size(), begins, first);
    ticks = newest - first;
    store(first, measured.acceleration.at.data());
    store(first, window_from_.data() + from);
    DoubleLanes late[2];
    divide(numbers - begins, ticks, late[0], late[1]);
    store(late[0], window_speed_.data() + from);
    store(late[1], window_speed_.data() + from + kSteps / 2);
    DoubleLanes early[2];
    pick(window_from_.data(), size(), begins, first);
    pick(window_speed_.data(), size(), begins, early[0], early[1]);
    DoubleLanes both[2];
    to_doubles(newest - first, both[0], both[1]);
    DoubleLanes acceleration[2];
    for (std::size_t half = 0; half < 2; ++half) {
        acceleration[half] = (late[half] - early[half]) / (0.5 * both[half]);
    }
    store_values(acceleration[0], acceleration[1], sign, measured.acceleration);

    for (std::size_t half = 0; half < 2; ++half) {
        const DoubleLanes amount = acceleration[half] < 0 ? -acceleration[half] : acceleration[half];
        FloatLanes of;
        by_turns(speed[half], amount, of);
        store(of, rates + half * kSteps / 2);
    }
}

}  // namespace lockstep::analysis
