// A comparison as the JSON report of `lockstep compare`.
#pragma once

#include "clients/methods/comparison.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::comparison {

proto::CompareReport to_report(const Comparison& comparison);

}  // namespace lockstep::comparison
