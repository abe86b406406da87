#include "clients/web/machine/task_queue.hpp"

#include <algorithm>
#include <utility>

namespace lockstep::web {

bool TaskQueue::poll(Entry& entry, Session& session, const SessionLease& lease) {
    Task& task = *entry.task;
    const bool waits = !entry.has_begun && task.lease() != Task::Lease::NotNeeded && !lease.is_held();
    if (!waits) {
        entry.has_begun = true;
        return task.poll(session);
    }
    auto refusal = lease.refusal(task.lease() == Task::Lease::Taken);
    return refusal && task.end(std::unexpected(*std::move(refusal)));
}

void TaskQueue::poll(Session& session, const SessionLease& lease) {
    auto tasks = std::exchange(tasks_, {});
    for (Entry& entry : tasks) {
        if (!poll(entry, session, lease)) { tasks_.push_back(std::move(entry)); }
    }
}

bool TaskQueue::sends() const {
    return std::ranges::any_of(tasks_, [](const Entry& entry) { return entry.task->sends(); });
}

bool TaskQueue::any_waits(Task::Lease least) const {
    return std::ranges::any_of(
        tasks_, [least](const Entry& entry) { return !entry.has_begun && entry.task->lease() >= least; });
}

bool TaskQueue::wants_lease() const { return any_waits(Task::Lease::Needed); }

bool TaskQueue::takes_lease() const { return any_waits(Task::Lease::Taken); }

}  // namespace lockstep::web
