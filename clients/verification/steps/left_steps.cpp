#include "clients/verification/steps/left_steps.hpp"

#include <algorithm>

namespace lockstep::verification {
namespace {

using analysis::Run;
using analysis::StepMaker;

/// The steps of a course, one by one.
class CourseMaker {
public:
    explicit CourseMaker(const Course& course) : course_(course), maker_(course.front()) { find_next(); }

    bool is_over() const { return is_over_; }
    StepEdge next() { return *maker_.next(); }
    Tick commanded() { return maker_.commanded(); }
    std::int64_t count_after() { return maker_.count() + next().direction; }
    const Run& run() const { return course_[run_]; }
    void pass() {
        maker_.pass();
        find_next();
    }

private:
    void find_next() {
        while (maker_.next() == nullptr && !is_over_) {
            is_over_ = run_ + 1 == course_.size();
            if (!is_over_) { maker_ = StepMaker(course_[++run_]); }
        }
    }

    const Course& course_;
    std::size_t run_ = 0;
    StepMaker maker_;
    bool is_over_ = false;
};

/// Compares one course with the steps.
class Comparison {
public:
    Comparison(const Course& course, const LeftBy& by) : made_(course), by_(by), incarnation_(by.incarnation) {}

    /// Returns false if the step is not the course's next one.
    bool take(const SeenStep& seen) {
        if (seen.incarnation != incarnation_) { go_to(seen); }
        if (made_.is_over() || !is_as_made(seen)) {
            note_misfit();
            return false;
        }
        note_run();
        made_.pass();
        ++found_.fit;
        return true;
    }
    LeftSteps finish() {
        for (; !made_.is_over(); made_.pass()) { ++found_.missing; }
        return found_;
    }

private:
    bool is_as_made(const SeenStep& seen) {
        return is_timely(seen) && made_.next().direction == seen.edge.direction &&
               made_.count_after() + offset_ == seen.count;
    }
    bool is_timely(const SeenStep& seen) {
        return length_of(seen.machine - made_.commanded()) <= allowed(seen.error, made_.run().clock_error);
    }
    bool is_before(const SeenStep& seen) {
        if (made_.commanded() + allowed(seen.error, made_.run().clock_error) < seen.machine) { return true; }
        return by_.zero_count && is_timely(seen) && made_.count_after() + *by_.zero_count != seen.count;
    }
    /// Skips to the first step that the next process published, by its time and by the device's count.
    void go_to(const SeenStep& seen) {
        incarnation_ = seen.incarnation;
        for (; !made_.is_over() && is_before(seen); made_.pass()) { ++found_.unrecorded; }
        if (!made_.is_over()) { offset_ = by_.zero_count.value_or(seen.count - made_.count_after()); }
    }
    void note_misfit() {
        found_.misfit = {.run = &made_.run()};
        if (made_.is_over()) { return; }
        found_.misfit->expected = made_.next();
        found_.misfit->count = made_.count_after() + offset_;
    }
    void note_run() {
        const Run& run = made_.run();
        if (noted_ == &run) { return; }
        const bool its_tail = noted_ != nullptr && run.tail;
        found_.runs += noted_ == nullptr ? name_of(run) : its_tail ? ", then its tail" : ", " + name_of(run);
        noted_ = &run;
    }

    CourseMaker made_;
    LeftBy by_;
    std::int64_t incarnation_;
    std::int64_t offset_ = 0;  // from machine coordinates to the process's count
    const Run* noted_ = nullptr;
    LeftSteps found_;
};

LeftSteps compare(std::span<const SeenStep> steps, const Course& course, const LeftBy& by) {
    Comparison comparison(course, by);
    (void)std::ranges::all_of(steps, [&](const SeenStep& seen) { return comparison.take(seen); });
    return comparison.finish();
}

}  // namespace

LeftSteps compare_left(std::span<const SeenStep> steps, std::span<const Course> courses, const LeftBy& by) {
    std::vector<LeftSteps> all;
    for (const Course& course : courses) { all.push_back(compare(steps, course, by)); }
    LeftSteps best = *std::ranges::max_element(all, {}, &LeftSteps::fit);
    for (const LeftSteps& other : all) {
        if (other.fit != best.fit) { continue; }
        if (!best.runs.contains(other.runs)) { best.runs += " or " + other.runs; }
        best.missing = std::min(best.missing, other.missing);
    }
    return best;
}

}  // namespace lockstep::verification
