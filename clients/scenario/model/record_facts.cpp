#include "clients/scenario/model/record_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "clients/verification/steps/run_stream.hpp"
#include "services/record/reading/log_read.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::scenario {
namespace {

using analysis::LogPlace;
using verification::RunStream;

class FactListener final : public analysis::LogListener {
public:
    RecordFacts facts;

    void on_position(const axis_position_t& message, LogPlace /*place*/) override {
        const bool rests = message.velocity_steps_per_s == 0;
        auto& spans = facts.rests[message.axis];
        if (rests && !was_at_rest_[message.axis]) { spans.push_back({{message.tick}, {message.tick}}); }
        if (rests) { spans.back().to = {message.tick}; }
        was_at_rest_[message.axis] = rests;
        Tick& last = facts.last_position[message.axis];
        last = std::max(last, Tick{message.tick});
    }
    void on_channel(const channel_event_t& message, LogPlace /*place*/) override {
        const auto event = event_of(message);
        if (event) { facts.channels[message.axis].push_back({Tick{message.tick + message.ahead}, *event}); }
    }
    void on_run(const run_t& message, LogPlace /*place*/) override {
        if (auto run = analysis::to_run(message)) { runs_of(message.axis).take(std::move(*run)); }
    }
    void on_steps(const step_batch_t& /*message*/, LogPlace /*place*/) override {}
    void on_job(const analysis::RecordedJob& /*message*/, LogPlace /*place*/) override {}
    void on_foreign(std::string_view /*channel*/) override {}
    void on_damage(LogPlace /*place*/, std::string /*what*/) override {}

    /// Call once, at the end of the log.
    void finish() {
        for (auto& [axis, runs] : runs_) { runs->finish(); }
        for (auto& [axis, changes] : facts.channels) { std::ranges::stable_sort(changes, {}, &NotedChange::at); }
    }

private:
    /// The runs of an axis in the order of their numbers: records may come late or twice.
    RunStream& runs_of(const std::string& axis) {
        auto& runs = runs_[axis];
        const auto note_end = [this, axis](const analysis::Run& run) {
            if (run.epoch != 0) { facts.epochs[run.epoch][axis] = {run.frame, run.tail}; }  // 0: its own move
        };
        const auto on_missing = [](std::int64_t /*from*/, std::int64_t /*end*/) {};
        if (!runs) {
            runs = std::make_unique<RunStream>(note_end, on_missing, [](const analysis::Run& /*other*/) {});
        }
        return *runs;
    }

    std::map<std::string, bool> was_at_rest_;
    std::map<std::string, std::unique_ptr<RunStream>> runs_;  // by axis
};

std::string rest_text(const std::string& axis, const EpochEnd& end) {
    return fmt::format("{} with {}frame {}", axis, end.tail ? "the tail of " : "", end.frame);
}

}  // namespace

std::optional<Tick> RecordFacts::all_at_rest(const std::vector<std::string>& axes, Tick since) const {
    for (Tick at = since;;) {
        const Tick tried = at;
        for (const std::string& axis : axes) {
            const auto spans = rests.find(axis);
            if (spans == rests.end()) { return std::nullopt; }
            const auto span = std::ranges::find_if(spans->second, [&](const RestSpan& rest) { return rest.to >= at; });
            if (span == spans->second.end()) { return std::nullopt; }
            at = std::max(at, span->from);
        }
        if (at == tried) { return at; }
    }
}

std::ptrdiff_t RecordFacts::epochs_of(const std::vector<std::string>& axes) const {
    return std::ranges::count_if(epochs, [&](const auto& epoch) {
        return std::ranges::count_if(axes, [&](const auto& axis) { return epoch.second.contains(axis); }) >= 2;
    });
}

std::optional<std::string> RecordFacts::parting(const std::vector<std::string>& axes) const {
    for (const auto& [epoch, ends] : epochs) {
        std::optional<std::pair<std::string, EpochEnd>> first;
        for (const auto& [axis, end] : ends) {
            if (std::ranges::find(axes, axis) == axes.end()) { continue; }
            if (!first) { first = {axis, end}; }
            if (end != first->second) {
                return fmt::format("epoch {}: {}, {}", epoch, rest_text(first->first, first->second),
                                   rest_text(axis, end));
            }
        }
    }
    return std::nullopt;
}

std::expected<RecordFacts, std::string> record_facts(const std::filesystem::path& log) {
    FactListener listener;
    const auto read = analysis::read_log(log, listener);
    if (!read) { return std::unexpected(read.error()); }
    listener.finish();
    return std::move(listener.facts);
}

}  // namespace lockstep::scenario
