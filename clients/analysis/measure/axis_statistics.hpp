// Measures the motion of one axis from its steps alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clients/analysis/measure/course.hpp"
#include "clients/analysis/measure/measured_step.hpp"
#include "clients/analysis/measure/speed_meter.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::analysis {

/// A step's tick and the position after it.
struct StepPlace {
    Tick tick;
    std::int64_t position_steps = 0;
};

class AxisStatistics final : public StepListener {
public:
    static constexpr std::size_t kBreaksKept = 1000;

    /// `keeps_curves`: speed() and acceleration() are wanted.
    explicit AxisStatistics(bool keeps_curves = true) : keeps_curves_(keeps_curves) {}

    /// Passes each step to `listener` too, with its measured values.
    void set_listener(MeasuredListener& listener, std::size_t lane) {
        listener_ = &listener;
        lane_ = lane;
    }
    void on_batch(const StepBatch& batch) override;
    void on_break(const Break& what) override;
    void on_contradiction(const Contradiction& what) override;
    /// Call once, at the end.
    void finish();

    std::int64_t steps() const { return steps_; }
    const std::optional<StepPlace>& first() const { return first_; }
    const std::optional<StepPlace>& last() const { return last_; }
    std::int64_t start_steps() const { return start_; }  // before the first step; 0 without steps
    double peak_steps_per_tick() const { return meter_.peak_steps_per_tick(); }
    double peak_steps_per_tick2() const { return meter_.peak_steps_per_tick2(); }
    std::vector<Sample> speed() const { return speed_.samples(); }                // steps per tick, signed
    std::vector<Sample> acceleration() const { return acceleration_.samples(); }  // steps per tick^2, signed

    const std::vector<Break>& breaks() const { return breaks_; }  // the first kBreaksKept
    std::int64_t break_count() const { return break_count_; }
    const std::vector<Contradiction>& contradictions() const { return contradictions_; }  // the first kBreaksKept
    /// The maximum error of the steps' times as machine time.
    Ticks clock_error() const { return clock_error_; }
    std::int64_t missing_batches() const { return missing_batches_; }
    /// Of these, the ones before the first batch of the log.
    std::int64_t missing_batches_before() const { return missing_batches_before_; }
    /// The minimum number of missing steps: the sum of the changes of position across missing batches.
    std::int64_t missing_steps() const { return missing_steps_; }

private:
    void begin(StepEdge edge, std::int64_t position_before);
    std::size_t measure_blocks(const StepBatch& batch, std::size_t from, MeasuredSteps& measured);
    void measure_taken(std::span<StepRates> rates);
    StepRates measure(StepEdge edge, Tick by_device);
    void stand_at(Tick tick);
    void show_rest(Tick from, Tick until);

    bool keeps_curves_;
    SpeedMeter meter_;
    Course speed_;
    Course acceleration_;
    MeasuredListener* listener_ = nullptr;
    std::size_t lane_ = 0;
    std::int64_t steps_ = 0;
    std::optional<StepPlace> first_;
    std::optional<StepPlace> last_;
    std::int64_t start_ = 0;
    Ticks clock_error_;
    std::vector<Break> breaks_;
    std::int64_t break_count_ = 0;
    std::vector<Contradiction> contradictions_;
    std::int64_t missing_batches_ = 0;
    std::int64_t missing_batches_before_ = 0;
    std::int64_t missing_steps_ = 0;
    bool joined_ = true;  // the next step follows the last one
};

}  // namespace lockstep::analysis
