#include "clients/analysis/measure/speed_meter.hpp"

#include "clients/analysis/vector/clones.hpp"
#include "clients/analysis/vector/lanes.hpp"

namespace lockstep::analysis {
namespace {

constexpr IntLanes kEachLane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

constexpr HalfIntLanes kEachOfHalf{0, 1, 2, 3, 4, 5, 6, 7};
constexpr std::size_t kHalf = SpeedMeter::kBlock / 2;

}  // namespace

void SpeedMeter::interrupt() {
    if (past_.size() > 1 && !measured_) { peak_speed_ = std::max(peak_speed_, least_speed_since(0)); }
    past_.clear();
    window_from_.clear();
    window_speed_.clear();
    windows_from_ = kNone;
    measured_ = false;
    speed_first_ = late_first_ = 0;
}

void SpeedMeter::begin_stretch(StepEdge edge, bool rested) {
    if (rested && edge.direction == direction_) {
        peak_speed_ = std::max(peak_speed_, 1 / static_cast<double>((edge.tick - tick(past_.size() - 1)).value));
    }
    interrupt();
    direction_ = edge.direction;
}

double SpeedMeter::least_speed_since(std::size_t first) const {
    return static_cast<double>(past_.size() - 1 - first) / static_cast<double>(past_.back() - past_[first] + 1);
}

void SpeedMeter::forget() {
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
    room_ = std::max(kKept, 2 * past_.size());
}

std::size_t SpeedMeter::take_blocks(std::span<const StepEdge> edges) {
    if (past_.empty() || !has_early_window(late_first_)) { return 0; }
    edges = edges.first(std::min(edges.size(), kKept));
    edges = edges.first(blocks_of_motion(edges) * kBlock);
    if (edges.empty()) { return 0; }
    if (past_.size() + edges.size() > room_) { forget(); }
    if (is_far(edges.back().tick)) { return 0; }
    measured_until_ = past_.size();
    past_.resize(measured_until_ + edges.size());
    window_from_.resize(past_.size());
    window_speed_.resize(past_.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        past_[measured_until_ + i] = static_cast<std::int32_t>((edges[i].tick - base_).value);
    }
    return edges.size();
}

void SpeedMeter::measure_block(Block& measured) {
    measure_speeds(measured_until_, measured.speed);
    measure_accelerations(measured_until_, measured.acceleration);
    measured_until_ += kBlock;
}

/// The number of blocks whose steps continue the motion. They complete windows, because the last step has.
LOCKSTEP_VECTOR_CLONES
std::size_t SpeedMeter::blocks_of_motion(std::span<const StepEdge> edges) const {
    Tick before = tick(past_.size() - 1);
    std::size_t blocks = 0;
    for (; (blocks + 1) * kBlock <= edges.size(); ++blocks) {
        const StepEdge* const block = edges.data() + blocks * kBlock;
        std::int32_t go_on = block[0].tick - before <= kRest && block[0].direction == direction_ ? 1 : 0;
        for (std::size_t i = 1; i < kBlock; ++i) {
            go_on &= block[i].tick - block[i - 1].tick <= kRest && block[i].direction == direction_ ? 1 : 0;
        }
        if (go_on == 0) { break; }
        before = block[kBlock - 1].tick;
    }
    return blocks;
}

/// The ticks of the steps with which windows begin.
[[gnu::always_inline]] inline SpeedMeter::Begins SpeedMeter::ticks_at(const Begins& begins) const {
    Begins ticks;
    for (std::size_t i = 0; i < kBlock; ++i) { ticks[i] = past_[static_cast<std::size_t>(begins[i])]; }
    return ticks;
}

/// The windows of half of the steps of the block at `from`.
[[gnu::always_inline]] inline SpeedMeter::Window SpeedMeter::window_of(std::size_t from, std::size_t half,
                                                                       const Begins& begins,
                                                                       const Begins& firsts) const {
    Window window;
    HalfIntLanes begin;
    load(begin, begins.data() + half);
    load(window.first, firsts.data() + half);
    load(window.ticks, past_.data() + from + half);
    window.ticks -= window.first;
    window.steps = kEachOfHalf + static_cast<std::int32_t>(from + half) - begin;
    return window;
}

LOCKSTEP_VECTOR_CLONES
void SpeedMeter::measure_speeds(std::size_t from, SampleBlock& measured) {
    Begins begins;
    narrow_all(speed_first_, kSpeedWindow, from, begins);
    const Begins firsts = ticks_at(begins);
    const double sign = direction_;
    for (std::size_t half = 0; half < kBlock; half += kHalf) {
        const Window window = window_of(from, half, begins, firsts);
        store(window.first + window.ticks / 2, measured.at.data() + half);
        DoubleLanes speed;
        divide(window.steps, window.ticks, speed);
        store(sign * speed, measured.value.data() + half);
    }
    measured.origin = base_;
    measured.find_range();
    peak_speed_ = std::max({peak_speed_, measured.highest, -measured.lowest});
}

LOCKSTEP_VECTOR_CLONES
void SpeedMeter::measure_accelerations(std::size_t from, SampleBlock& measured) {
    Begins begins;
    narrow_all(late_first_, kAccelerationWindow, from, begins);
    measured.at = ticks_at(begins);
    for (std::size_t half = 0; half < kBlock; half += kHalf) {
        const Window window = window_of(from, half, begins, measured.at);
        store(window.first, window_from_.data() + from + half);
        DoubleLanes speed;
        divide(window.steps, window.ticks, speed);
        store(speed, window_speed_.data() + from + half);
    }
    Begins early_from;
    std::array<double, kBlock> early_speed;
    for (std::size_t i = 0; i < kBlock; ++i) {
        early_from[i] = window_from_[static_cast<std::size_t>(begins[i])];
        early_speed[i] = window_speed_[static_cast<std::size_t>(begins[i])];
    }
    const double sign = direction_;
    for (std::size_t half = 0; half < kBlock; half += kHalf) {
        DoubleLanes late;
        DoubleLanes early;
        load(late, window_speed_.data() + from + half);
        load(early, early_speed.data() + half);
        const Window both = window_of(from, half, begins, early_from);
        store(sign * ((late - early) / (0.5 * __builtin_convertvector(both.ticks, DoubleLanes))),
              measured.value.data() + half);
    }
    measured.origin = base_;
    measured.find_range();
    peak_acceleration_ = std::max({peak_acceleration_, measured.highest, -measured.lowest});
    acceleration_ = measured[kBlock - 1];
}

/// narrow() for each step of a block.
void SpeedMeter::narrow_all(std::size_t& first, std::int32_t least, std::size_t from, Begins& begins) const {
    (void)narrow(first, least, from);
    if (!narrow_near(first, least, from, begins)) {
        begins[0] = static_cast<std::int32_t>(first);
        for (std::size_t i = 1; i < kBlock; ++i) {
            (void)narrow(first, least, from + i);
            begins[i] = static_cast<std::int32_t>(first);
        }
    }
    first = static_cast<std::size_t>(begins.back());
}

/// Finds windows of almost equally many steps, without branches, which would be mispredicted. `first` is the begin of
/// the first one. Returns false if they have other numbers of steps.
LOCKSTEP_VECTOR_CLONES
bool SpeedMeter::narrow_near(std::size_t first, std::int32_t least, std::size_t from, Begins& begins) const {
    constexpr std::int32_t kNear = 3;  // steps more or fewer
    if (first < kNear) { return false; }
    const std::int32_t* const shortest = past_.data() + from - kLeastSteps;
    const std::int32_t* const longest = past_.data() + first - kNear;
    IntLanes until;
    IntLanes place;
    load(until, past_.data() + from);
    until -= least;
    const IntLanes latest = kEachLane + static_cast<std::int32_t>(from - kLeastSteps);
    load(place, shortest);
    if (all_true(place <= until)) {
        store(latest, begins.data());
        return true;
    }
    IntLanes fit{};
    for (std::int32_t k = 0; k <= 2 * kNear; ++k) {
        load(place, longest + k);
        fit -= place <= until;
    }
    load(place, longest + 2 * kNear + 1);
    const IntLanes begin = kEachLane + fit + static_cast<std::int32_t>(first - kNear - 1);
    store(begin < latest ? begin : latest, begins.data());
    return all_true(fit > 0) && all_true(place > until);
}

}  // namespace lockstep::analysis
