// A technique's parameters as data: what its visit() says, in the shape that JSON, flags, forms and documents need.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/parameter.h"
#include "tessera/base/status.h"
#include "tessera/job/job.h"

namespace tessera {

using Json = nlohmann::ordered_json;

enum class ParameterKind { kNumber, kInteger, kFlag, kText, kChoice };

struct ParameterChoice {
  const char* name;
  const char* help;
};

struct Parameter {
  ParameterInfo info;
  ParameterKind kind = ParameterKind::kNumber;
  Json value;                            // of the params that were asked; whole numbers are JSON integers
  std::vector<ParameterChoice> choices;  // of kChoice
};

// The parameters in the order in which the technique names them, with the values of `params`.
std::vector<Parameter> parameters_of(const TechniqueParams& params);

// What a value must be: "a number, 1 to 512 px", "a whole number, 2 to 16", "exact or chamfer".
std::string expectation(const Parameter& parameter);
// "1 to 512 px"; empty where any value will do.
std::string range_text(const ParameterInfo& info);
// "half-side" of "halfSide".
std::string kebab_case(std::string_view key);
// "a", "a or b", "a, b or c".
std::string either_of(const std::vector<std::string>& words);
// A value as it is shown in a message: one line, not long, texts in quotes.
std::string shown(const Json& value);
// A key that came from outside, in a form that fits a message.
std::string shown_key(const std::string& key);
// A value as a person would type it: texts without quotes.
std::string plain_text(const Json& value);
// A JSON integer where the value is whole: 4 rather than 4.0.
Json tidy_number(double value);

// The seed is described as parameters are.
inline constexpr ParameterInfo kSeedInfo{
    .key = "seed", .min = 0, .max = static_cast<double>(kMaxSeed), .help = "Start of the random numbers"};

// What is wrong with `value` as this parameter ("is 0.2, expected 1 to 512 px"), if anything is.
std::optional<std::string> complaint(const Parameter& parameter, const Json& value);

// Every parameter, in order.
Json write_params(const TechniqueParams& params);
// Takes the members of `object` into `params`, whose other fields stay. Adds every problem there is: unknown keys,
// wrong types, values out of range, fields that do not go together. Fields with a problem keep their value.
void read_params(const Json& object, TechniqueParams& params, Problems& problems);
// Adds what is wrong with parameters that did not come from JSON.
void check_params(const TechniqueParams& params, Problems& problems);

}  // namespace tessera
