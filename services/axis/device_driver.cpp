#include "services/axis/device_driver.hpp"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <limits>

#include "core/protocol/frame_room.hpp"
#include "core/step/executable.hpp"
#include "sim_fpga/channel_words.hpp"

namespace lockstep {
namespace {

using namespace registers;

constexpr std::uint64_t kNoVeto = std::numeric_limits<std::uint64_t>::max();
/// An update takes well under a microsecond and a read about ten nanoseconds. If the device is still in an update after
/// this many reads, its process has stalled.
constexpr int kMaxLooks = 1000;

std::string hex(std::uint64_t value) {
    char text[19];
    std::snprintf(text, sizeof text, "0x%016" PRIX64, value);
    return text;
}

/// A register that identifies the device and its version.
struct Identification {
    const char* name;
    std::size_t offset;
    std::uint64_t expected;
    const char* remedy;
};

/// The number of entries in a ring. Error: head and tail contradict each other.
std::expected<std::uint64_t, std::string> entries_in(const char* ring, std::uint64_t head, std::uint64_t tail,
                                                     std::uint64_t capacity) {
    if (head - tail <= capacity) { return head - tail; }
    return std::unexpected(std::string("device: ") + ring + " head " + hex(head) + " and tail " + hex(tail) +
                           " are impossible: the ring has " + std::to_string(capacity) +
                           " entries; restart the device");
}

std::uint64_t raw(std::int64_t value) { return static_cast<std::uint64_t>(value); }

Ticks longest_piece(const AxisTrack& track) {
    Ticks longest;
    const auto take = [&longest](const Piece& piece) { longest = std::max(longest, piece.ticks); };
    std::ranges::for_each(track.body, take);
    std::ranges::for_each(track.tail, take);
    return longest;
}

/// Writes a frame into the segment ring in order, and publishes it whole.
class FrameWriter {
public:
    FrameWriter(RegisterWindow window, const RegisterRing& ring)
        : window_(std::move(window)), ring_(ring), head_(window_.load(kSegmentHead)) {}

    void begin(const device::LoadFrame& frame) {
        const AxisTrack& track = frame.track;
        const std::size_t at = ring_.entry(head_++);
        window_.store(at + kSegmentRingHeaderTag, kSegmentRingHeaderTagIsHeader |
                                                      (frame.last ? kSegmentRingHeaderTagLastFrame : 0) |
                                                      kSegmentRingHeaderTagRun.word(window_.load(kRunRequest)) |
                                                      kSegmentRingHeaderTagFrame.word(frame.number));
        window_.store(at + kSegmentRingHeaderStart, raw(frame.start.value));
        window_.store(at + kSegmentRingHeaderCounts, kSegmentRingHeaderCountsCount.word(raw(track.from.count())) |
                                                         kSegmentRingHeaderCountsBody.word(track.body.size()) |
                                                         kSegmentRingHeaderCountsTail.word(track.tail.size()));
        window_.store(at + kSegmentRingHeaderPhase, track.from.phase());
    }
    void write(const Piece& piece) {
        const std::size_t at = ring_.entry(head_++);
        window_.store(at + kSegmentRingPieceTag, kSegmentRingPieceTagTicks.word(raw(piece.ticks.value)));
        window_.store(at + kSegmentRingPieceVelocity, raw(piece.velocity.raw));
        window_.store(at + kSegmentRingPieceAcceleration, raw(piece.acceleration.raw));
    }
    void publish() { window_.store(kSegmentHead, head_); }

private:
    RegisterWindow window_;
    RegisterRing ring_;
    std::uint64_t head_;
};

/// Error: the word is not a number of entries that the map allows.
std::expected<std::uint64_t, std::string> ring_size(const RegisterWindow& window, const char* name, std::size_t word,
                                                    std::uint64_t least, std::uint64_t most) {
    const std::uint64_t entries = window.load(word);
    if (std::has_single_bit(entries) && least <= entries && entries <= most) { return entries; }
    return std::unexpected(std::string("device: ") + name + " reads " + hex(entries) +
                           ", expected a power of two from " + std::to_string(least) + " to " + std::to_string(most) +
                           "; restart the device");
}

/// Error: the word is greater than the map allows.
std::expected<std::uint64_t, std::string> channels(const RegisterWindow& window, const char* name, std::size_t word,
                                                   std::uint64_t most) {
    const std::uint64_t count = window.load(word);
    if (count <= most) { return count; }
    return std::unexpected(std::string("device: ") + name + " reads " + hex(count) + ", expected at most " +
                           std::to_string(most) + "; restart the device");
}

/// Reads what the inputs and outputs can do into `abilities`. Error: it is impossible.
std::expected<void, std::string> read_channels(const RegisterWindow& window, DeviceAbilities& abilities) {
    constexpr std::uint64_t kLeast = 16;
    struct Word {
        const char* name;
        std::size_t word;
        std::uint64_t most;
        std::uint64_t& to;
    };
    for (const auto& [name, word, most, to] :
         {Word{"INPUT_CHANNELS", kInputChannels, kMostInputs, abilities.inputs},
          {"DIGITAL_CHANNELS", kDigitalChannels, kMostDigitalOutputs, abilities.digital_outputs},
          {"ANALOG_CHANNELS", kAnalogChannels, kMostAnalogOutputs, abilities.analog_outputs}}) {
        const auto count = channels(window, name, word, most);
        if (!count) { return std::unexpected(count.error()); }
        to = *count;
    }
    for (const auto& [name, word, most, to] :
         {Word{"OUTPUT_ENTRIES", kOutputEntries, kOutputRingMostEntries, abilities.output_entries},
          {"EVENT_ENTRIES", kEventEntries, kEventRingMostEntries, abilities.event_entries}}) {
        to = window.load(word);
        if (to == 0) { continue; }
        const auto entries = ring_size(window, name, word, kLeast, most);
        if (!entries) { return std::unexpected(entries.error()); }
    }
    return {};
}

/// Reads the numbers of ticks into `abilities`. Error: one is impossible.
std::expected<void, std::string> read_ticks(const RegisterWindow& window, DeviceAbilities& abilities) {
    struct Word {
        const char* name;
        std::size_t word;
        std::uint64_t least;
        Ticks& to;
    };
    const auto most = raw(kMaxPieceTicks.value);
    for (const auto& [name, word, least, to] : {Word{"LEAST_STEP_TICKS", kLeastStepTicks, 1, abilities.least_step},
                                                {"LONGEST_PIECE_TICKS", kLongestPieceTicks, 1, abilities.longest_piece},
                                                {"LEAD_TICKS", kLeadTicks, 0, abilities.lead},
                                                {"PIN_TICKS", kPinTicks, 0, abilities.behind}}) {
        const std::uint64_t ticks = window.load(word);
        if (ticks < least || ticks > most) {
            return std::unexpected(std::string("device: ") + name + " reads " + hex(ticks) + ", expected " +
                                   std::to_string(least) + " to " + std::to_string(most) + "; restart the device");
        }
        to = {static_cast<std::int64_t>(ticks)};
    }
    return {};
}

std::expected<DeviceAbilities, std::string> read_abilities(const RegisterWindow& window) {
    constexpr std::uint64_t kLeastSegments = 16;
    constexpr std::uint64_t kLeastCaptures = 256;
    const auto segments =
        ring_size(window, "SEGMENT_ENTRIES", kSegmentEntries, kLeastSegments, kSegmentRingMostEntries);
    if (!segments) { return std::unexpected(segments.error()); }
    const auto captures =
        ring_size(window, "CAPTURE_ENTRIES", kCaptureEntries, kLeastCaptures, kCaptureRingMostEntries);
    if (!captures) { return std::unexpected(captures.error()); }
    const std::uint64_t features = window.load(kFeatures);
    DeviceAbilities abilities{.segment_entries = *segments,
                              .capture_entries = *captures,
                              .time_unit_ps = std::max(window.load(kTimeUnitPs), std::uint64_t{1}),
                              .longest_time = window.load(kLongestTime),
                              .longest_pwm_period = window.load(kLongestPwmPeriod),
                              .has_encoder = (features & kFeaturesEncoder) != 0,
                              .can_enable = (features & kFeaturesEnable) != 0,
                              .can_compare = (features & kFeaturesCompare) != 0,
                              .frames_stay = (features & kFeaturesFramesStay) != 0};
    if (const auto read = read_ticks(window, abilities); !read) { return std::unexpected(read.error()); }
    if (const auto read = read_channels(window, abilities); !read) { return std::unexpected(read.error()); }
    return abilities;
}

/// Called at every read, because memory that was removed or overwritten no longer shows these values.
std::expected<void, std::string> identify(const RegisterWindow& window, std::int64_t tick_ns) {
    const Identification words[] = {
        {"MAGIC", kMagic, kMagicValue, "check that this is a Lockstep axis device and that it has power"},
        {"VERSION", kVersion, kVersionValue, "install the same release on device and host"},
        {"MAP_CHECKSUM", kMapChecksum, kMapChecksumValue, "install the same release on device and host"},
        {"TICK_NS", kTickNs, static_cast<std::uint64_t>(tick_ns), "set the same tick_ns for device and host"},
    };
    for (const auto& [name, offset, expected, remedy] : words) {
        if (const std::uint64_t found = window.load(offset); found != expected) {
            return std::unexpected(std::string("device: ") + name + " reads " + hex(found) + ", expected " +
                                   hex(expected) + "; " + remedy);
        }
    }
    return {};
}

/// Error: the motor may not be where the device counts it.
std::expected<void, std::string> has_all_ticks(const RegisterWindow& window) {
    if ((window.load(kStatus) & kStatusLostTicks) == 0) { return {}; }
    return std::unexpected(
        "device: STATUS shows LOST_TICKS: its pulses did not come at their ticks, because it was too busy, or starved; "
        "power it up again");
}

}  // namespace

std::expected<DeviceDriver, std::string> DeviceDriver::attach(RegisterWindow window, std::int64_t tick_ns) {
    if (const auto known = identify(window, tick_ns); !known) { return std::unexpected(known.error()); }
    if (const auto sound = has_all_ticks(window); !sound) { return std::unexpected(sound.error()); }
    const auto abilities = read_abilities(window);
    if (!abilities) { return std::unexpected(abilities.error()); }
    DeviceDriver driver(std::move(window), tick_ns, *abilities);
    if (const auto segments = driver.segments(); !segments) { return std::unexpected(segments.error()); }
    if (const auto captures = driver.captures(); !captures) { return std::unexpected(captures.error()); }
    if (const auto changes = driver.changes(); !changes) { return std::unexpected(changes.error()); }
    if (const auto events = driver.events(); !events) { return std::unexpected(events.error()); }
    return driver;
}

DeviceDriver::DeviceDriver(RegisterWindow window, std::int64_t tick_ns, const DeviceAbilities& abilities)
    : window_(std::move(window)),
      tick_ns_(tick_ns),
      abilities_(abilities),
      segment_ring_(kSegmentRing, abilities.segment_entries, kSegmentRingEntryBytes),
      capture_ring_(kCaptureRing, abilities.capture_entries, kCaptureRingEntryBytes),
      output_ring_(kOutputRing, abilities.output_entries, kOutputRingEntryBytes),
      event_ring_(kEventRing, abilities.event_entries, kEventRingEntryBytes),
      beat_(window_.load(kBeat)) {}

DeviceDriver::Result DeviceDriver::set_up(const DeviceSetup& setup) {
    if (auto lack = lack_of(abilities_, setup)) { return std::unexpected(std::move(*lack)); }
    store_setup(window_, setup, abilities_.time_unit_ps);
    window_.store(kBeat, ++beat_);
    window_.store(kSetupRequest, std::max(window_.load(kSetupRequest) + 1, std::uint64_t{1}));
    window_.store(kEnable, 1);
    return {};
}

std::expected<std::uint64_t, std::string> DeviceDriver::changes() const {
    return entries_in("output ring", window_.load(kOutputHead), window_.load(kOutputTail), output_ring_.entries());
}

std::expected<std::uint64_t, std::string> DeviceDriver::events() const {
    return entries_in("event ring", window_.load(kEventHead), window_.load(kEventTail), event_ring_.entries());
}

std::expected<std::uint64_t, std::string> DeviceDriver::segments() const {
    return entries_in("segment ring", window_.load(kSegmentHead), window_.load(kSegmentTail), segment_ring_.entries());
}

std::expected<std::uint64_t, std::string> DeviceDriver::captures() const {
    return entries_in("capture ring", window_.load(kCaptureHead), window_.load(kCaptureTail), capture_ring_.entries());
}

std::expected<DeviceStatus, std::string> DeviceDriver::read() {
    window_.store(kBeat, ++beat_);
    for (int look = 0; look < kMaxLooks; ++look) {
        const std::uint64_t before = window_.load(kSequence);
        DeviceStatus status = read_words();
        const auto loaded = segments();
        if (const auto known = identify(window_, tick_ns_); !known) { return std::unexpected(known.error()); }
        if (before % 2 != 0 || window_.load(kSequence) != before) { continue; }
        if (!loaded) { return std::unexpected(loaded.error()); }
        if (const auto sound = has_all_ticks(window_); !sound) { return std::unexpected(sound.error()); }
        if (status.bad_setup) {
            return std::unexpected("device: it refuses its setup, which its own abilities allow; restart the device");
        }
        status.free_segments = static_cast<std::uint32_t>(segment_ring_.entries() - *loaded);
        stale_reads_ = 0;
        last_look_ = status;
        return status;
    }
    return stale_look();
}

std::expected<DeviceStatus, std::string> DeviceDriver::stale_look() {
    if (last_look_ && ++stale_reads_ <= kMaxStaleReads) {
        last_look_->run_asked = window_.load(kRunRequest);  // the host's own register
        return *last_look_;
    }
    return std::unexpected("device: SEQUENCE reads " + hex(window_.load(kSequence)) +
                           ": the device stopped in the middle of an update; restart it");
}

DeviceStatus DeviceDriver::read_words() const {
    const std::uint64_t status = window_.load(kStatus);
    const auto has = [status](std::uint64_t bit) { return (status & bit) != 0; };
    return {
        .now = {signed_word(kTick)},
        .position = Position::from_count(signed_word(kCount), window_.load(kPhase)),
        .velocity = {signed_word(kVelocity)},
        .moving = has(kStatusMoving),
        .power_up = window_.load(kPowerUp),
        .run = window_.load(kRun),
        .run_asked = window_.load(kRunRequest),
        .frame = window_.load(kFrame),
        .finished = has(kStatusFinished),
        .in_tail = has(kStatusInTail),
        .limit_min = has(kStatusLimitMin),
        .limit_max = has(kStatusLimitMax),
        .home = has(kStatusHome),
        .stopped_by_limit = has(kStatusStoppedByLimit),
        .stopped_by_trigger = has(kStatusStoppedByTrigger),
        .stopped_by_host = has(kStatusStoppedByHost),
        .trigger_count = signed_word(kTriggerCount),
        .bad_segment = has(kStatusBadSegment),
        .capture_overflow = has(kStatusCaptureOverflow),
        .encoder_count = signed_word(kEncoder),
        .inputs = static_cast<std::uint32_t>(window_.load(kInputs)),
        .outputs = static_cast<std::uint16_t>(window_.load(kOutputs)),
        .pulses_left = static_cast<std::uint32_t>(window_.load(kPulsesLeft)),
        .analog = load_analog(window_),
        .enabled = has(kStatusEnabled),
        .bad_setup = has(kStatusBadSetup),
        .host_silent = has(kStatusHostSilent),
        .stopped_by_input = has(kStatusStoppedByInput),
        .bad_output = has(kStatusBadOutput),
    };
}

std::expected<void, std::string> DeviceDriver::apply(const DeviceOrder& order) {
    return std::visit([this](const auto& one) { return apply_one(one); }, order);
}

/// The order matters: it first withdraws ARMED, then lifts VETO, and writes the run's number last. The device reads
/// them in reverse order.
DeviceDriver::Result DeviceDriver::apply_one(const device::BeginRun& order) {
    if (order.run == 0 || order.run == window_.load(kRunRequest)) {
        return std::unexpected("device: run " + std::to_string(order.run) +
                               " did not begin: its number must be new and not 0; continue from the number in RUN");
    }
    window_.store(kArmed, 0);
    window_.store(kVeto, kNoVeto);
    window_.store(kTrigger, trigger_word(order));
    window_.store(kRunRequest, order.run);
    return {};
}

std::uint64_t DeviceDriver::trigger_word(const device::BeginRun& order) const {
    switch (order.trigger) {
        case Trigger::None: return 0;
        case Trigger::HomeCloses: return kTriggerInputs.word(window_.load(kHomeInputs));
        case Trigger::HomeOpens: return kTriggerInputs.word(window_.load(kHomeInputs)) | kTriggerOpens;
        case Trigger::InputCloses: return kTriggerInputs.word(1ULL << order.channel);
        case Trigger::InputOpens: return kTriggerInputs.word(1ULL << order.channel) | kTriggerOpens;
    }
    return 0;
}

DeviceDriver::Result DeviceDriver::apply_one(const device::LoadFrame& order) {
    const auto refuse = [&order](const std::string& why) {
        return std::unexpected("device: frame " + std::to_string(order.number) + " is not loaded: " + why);
    };
    const auto loaded = segments();
    if (!loaded) { return std::unexpected(loaded.error()); }
    const std::size_t needed = ring_entries(order.track);
    const std::size_t room = segment_ring_.entries() - *loaded;
    if (needed > room) {
        return refuse("the frame has " + std::to_string(needed) + " entries, but the ring has room for " +
                      std::to_string(room));
    }
    if (order.track.body.empty()) { return refuse("the frame has no body"); }
    if (const Ticks longest = longest_piece(order.track); longest > abilities_.longest_piece) {
        return refuse("a piece has " + std::to_string(longest.value) + " ticks, but the device's have at most " +
                      std::to_string(abilities_.longest_piece.value));
    }
    if (window_.load(kRunRequest) == 0) { return refuse("no run has been begun"); }
    FrameWriter writer(window_, segment_ring_);
    writer.begin(order);
    for (const Piece& piece : order.track.body) { writer.write(piece); }
    for (const Piece& piece : order.track.tail) { writer.write(piece); }
    writer.publish();
    return {};
}

DeviceDriver::Result DeviceDriver::apply_one(const device::LoadOutputs& order) {
    const auto loaded = changes();
    if (!loaded) { return std::unexpected(loaded.error()); }
    const std::size_t needed = order.track.body.size() + order.track.tail.size();
    const std::size_t room = output_ring_.entries() - *loaded;
    if (needed > room) {
        return std::unexpected("device: the outputs of frame " + std::to_string(order.number) +
                               " are not loaded: they change " + std::to_string(needed) +
                               " times, but the ring has room for " + std::to_string(room));
    }
    std::uint64_t head = window_.load(kOutputHead);
    OutputPlace place{.run = window_.load(kRunRequest), .frame = order.number, .is_tail = false};
    const auto write = [&](const OutputChange& change) {
        store_change(window_, output_ring_.entry(head++), place, change);
    };
    std::ranges::for_each(order.track.body, write);
    place.is_tail = true;
    std::ranges::for_each(order.track.tail, write);
    window_.store(kOutputHead, head);
    return {};
}

DeviceDriver::Result DeviceDriver::apply_one(const device::ChangeOutputs& order) {
    std::uint64_t channels = 0;
    for (const RampAnalog& analog : order.analog) {
        const std::size_t entry = kAnalogTable + analog.channel * kAnalogTableEntryBytes;
        window_.store(entry + kAnalogTableDirectValue, raw(analog.value));
        channels |= std::uint64_t{1} << analog.channel;
    }
    window_.store(kDirectOutputs, kDirectOutputsLevels.word(order.digital.levels) |
                                      kDirectOutputsMask.word(order.digital.mask) |
                                      kDirectOutputsAnalogMask.word(channels));
    window_.store(kDirectRequest, window_.load(kDirectRequest) + 1);
    return {};
}

DeviceDriver::Result DeviceDriver::apply_one(const device::Arm& order) {
    window_.store(kArmed, std::max(window_.load(kArmed), order.number));
    return {};
}

DeviceDriver::Result DeviceDriver::apply_one(const device::Veto& order) {
    window_.store(kVeto, std::min(window_.load(kVeto), order.number));
    return {};
}

DeviceDriver::Result DeviceDriver::apply_one(const device::StopNow&) {
    window_.store(kStop, window_.load(kRunRequest));
    return {};
}

std::expected<std::uint64_t, std::string> DeviceDriver::drain_capture(const std::function<void(StepEdge)>& on_step) {
    const auto captured = captures();
    if (!captured) { return captured; }
    const std::uint64_t tail = window_.load(kCaptureTail);
    const Tick now{signed_word(kTick)};  // read after the head, so no step in the ring is later than this tick
    for (std::uint64_t index = tail; index != tail + *captured; ++index) {
        const std::uint64_t word = window_.load(capture_ring_.entry(index) + kCaptureRingStep);
        const StepEdge step{.tick = {static_cast<std::int64_t>(word) >> kCaptureRingStepTick.low},
                            .direction = static_cast<std::int8_t>(word & kCaptureRingStepForward ? 1 : -1)};
        if (step.tick > now || (last_step_ && step.tick <= *last_step_)) {
            return std::unexpected("device: capture ring entry " + std::to_string(index) + " reads tick " +
                                   std::to_string(step.tick.value) + ", which is impossible at tick " +
                                   std::to_string(now.value));
        }
        last_step_ = step.tick;
        on_step(step);
    }
    window_.store(kCaptureTail, tail + *captured);
    return captured;
}

std::expected<std::uint64_t, std::string> DeviceDriver::drain_events(
    const std::function<void(const ChannelEvent&)>& on_event) {
    const auto waiting = events();
    if (!waiting) { return waiting; }
    const std::uint64_t tail = window_.load(kEventTail);
    const Tick now{signed_word(kTick)};  // read after the head, so no event in the ring is later than this tick
    for (std::uint64_t index = tail; index != tail + *waiting; ++index) {
        const auto event = load_event(window_, event_ring_.entry(index));
        if (!event || event->tick > now || (last_event_ && event->tick < *last_event_)) {
            return std::unexpected("device: event ring entry " + std::to_string(index) + " is impossible at tick " +
                                   std::to_string(now.value) + "; restart the device");
        }
        last_event_ = event->tick;
        on_event(*event);
    }
    window_.store(kEventTail, tail + *waiting);
    return waiting;
}

}  // namespace lockstep
