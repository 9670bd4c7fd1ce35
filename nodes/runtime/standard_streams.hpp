#pragma once

namespace trivela::nodes {

/// First thing in a main: whoever closed standard input, output or error must not have what this process opens next in
/// their place: a log line would go into a socket or a database. What is written to a stream that was closed fails as
/// before.
void secure_standard_streams();

}  // namespace trivela::nodes
