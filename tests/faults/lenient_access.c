// Cyclone's access control without its look at what the own participant may write: what somebody uses who has a
// node's certificate and permissions and wants more than they say. What others think of him stays as it is.
#include <dds/security/dds_security_api.h>

int init_access_control(const char* argument, void** context, struct ddsi_domaingv* gv);
int finalize_access_control(void* context);

static DDS_Security_boolean anything(dds_security_access_control* instance, DDS_Security_PermissionsHandle permissions,
                                     DDS_Security_DomainId domain_id, const char* topic,
                                     const DDS_Security_Qos* writer_qos,
                                     const DDS_Security_PartitionQosPolicy* partition,
                                     const DDS_Security_DataTags* data_tag, DDS_Security_SecurityException* exception) {
  (void)instance, (void)permissions, (void)domain_id, (void)topic;
  (void)writer_qos, (void)partition, (void)data_tag, (void)exception;
  return 1;
}

static DDS_Security_boolean any_topic(dds_security_access_control* instance, DDS_Security_PermissionsHandle permissions,
                                      DDS_Security_DomainId domain_id, const char* topic, const DDS_Security_Qos* qos,
                                      DDS_Security_SecurityException* exception) {
  (void)instance, (void)permissions, (void)domain_id, (void)topic, (void)qos, (void)exception;
  return 1;
}

int init_lenient_access(const char* argument, void** context, struct ddsi_domaingv* gv) {
  const int failed = init_access_control(argument, context, gv);
  if (failed != 0) return failed;
  dds_security_access_control* const control = *context;
  control->check_create_topic = any_topic;
  control->check_create_datawriter = anything;
  return 0;
}

int finalize_lenient_access(void* context) { return finalize_access_control(context); }
