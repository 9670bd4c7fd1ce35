#include "security/rights.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include "idl/messages.hpp"

namespace trivela::security {
namespace {

// config/domain: ids above 100 are refused by bus/domain/domain.cpp.
constexpr const char* kDomains = "<domains><id_range><min>0</min><max>100</max></id_range></domains>";

std::string topic_rule(std::string_view topic, const char* parts) {
  return fmt::format(R"(      <topic_rule>
        <topic_expression>{}</topic_expression>
        <enable_discovery_protection>true</enable_discovery_protection>
        <enable_liveliness_protection>true</enable_liveliness_protection>
        <enable_read_access_control>true</enable_read_access_control>
        <enable_write_access_control>true</enable_write_access_control>
        <metadata_protection_kind>{}</metadata_protection_kind>
        <data_protection_kind>NONE</data_protection_kind>
      </topic_rule>
)",
                     topic, parts);
}

std::string topic_list(const char* verb, const std::vector<std::string>& topics) {
  if (topics.empty()) return {};
  std::string text = fmt::format("      <{}><topics>", verb);
  for (const std::string& topic : topics) text += fmt::format("<topic>{}</topic>", topic);
  return text + fmt::format("</topics></{}>\n", verb);
}

std::string instant(std::chrono::sys_seconds t) { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(t)); }

}  // namespace

std::string governance_xml(Bus bus) {
  const bool robot = bus == Bus::kRobot;
  std::string rules;
  if (robot)
    for (const std::string_view topic :
         {trivela::bus::meta<msg::KickOrder>::topic, trivela::bus::meta<msg::KickerStatus>::topic,
          trivela::bus::meta<msg::Referee>::topic})
      rules += topic_rule(topic, "ENCRYPT");
  rules += topic_rule("*", "NONE");  // the first rule that fits counts
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules><domain_rule>
    {}
    <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
    <enable_join_access_control>true</enable_join_access_control>
    <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
    <liveliness_protection_kind>SIGN</liveliness_protection_kind>
    <rtps_protection_kind>{}</rtps_protection_kind>
    <topic_access_rules>
{}    </topic_access_rules>
  </domain_rule></domain_access_rules>
</dds>
)",
                     kDomains, robot ? "SIGN" : "ENCRYPT", rules);
}

std::string permissions_xml(const Rights& rights, std::uint32_t robot_id, const Validity& validity) {
  const std::string name = common_name(rights.node, robot_id);
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions><grant name="{0}">
    <subject_name>O=Trivela,CN={0}</subject_name>
    <validity><not_before>{1}</not_before><not_after>{2}</not_after></validity>
    <allow_rule>
      {3}
{4}{5}    </allow_rule>
    <default>DENY</default>
  </grant></permissions>
</dds>
)",
                     name, instant(validity.from), instant(validity.to), kDomains,
                     topic_list("publish", rights.publish), topic_list("subscribe", rights.subscribe));
}

}  // namespace trivela::security
