// idlc back-end (idlc -l): for each x.idl writes x.hpp with the C++ names of its types, a bus::meta<T> per struct
// (name, fields with units, members, visitor; for topics also topic, profile, writers and descriptor), the labels of its
// enums and for_each_message_of_x().
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <idl/file.h>
#include <idl/processor.h>
#include <idlc/generator.h>

// Writes the names of the modules around a node, outermost first, each followed by the separator.
static void print_scope(FILE* out, const void* node, const char* separator) {
  const idl_node_t* parent = idl_parent(node);
  if (parent == NULL) return;
  print_scope(out, parent, separator);
  fprintf(out, "%s%s", idl_identifier(parent), separator);
}

static void print_c_name(FILE* out, const void* node) {
  fputs("::", out);
  print_scope(out, node, "_");
  fputs(idl_identifier(node), out);
}

static void print_cpp_name(FILE* out, const void* node) {
  fputs("::", out);
  print_scope(out, node, "::");
  fputs(idl_identifier(node), out);
}

// namespace a::b { <using T = ::a_b_T;> ... left open for more of the same scope.
static void open_namespace_with_alias(FILE* out, const void* node) {
  fputs("\nnamespace ", out);
  print_scope(out, idl_parent(node), "::");
  fprintf(out, "%s {\nusing %s = ", idl_identifier(idl_parent(node)), idl_identifier(node));
  print_c_name(out, node);
  fputs(";\n", out);
}

// The text given to @name("...") on the node, or NULL.
static const char* annotation_text(const idl_node_t* node, const char* name) {
  for (const idl_annotation_appl_t* a = node->annotations; a != NULL; a = idl_next(a))
    if (strcmp(a->annotation->name->identifier, name) == 0 && a->parameters != NULL)
      return ((const idl_literal_t*)a->parameters->const_expr)->value.str;
  return NULL;
}

// How many leading characters all enumerators share, up to and with their last common '_'.
static size_t common_prefix(const idl_enum_t* node) {
  const char* first = idl_identifier(node->enumerators);
  size_t length = strlen(first);
  for (const idl_enumerator_t* e = idl_next(node->enumerators); e != NULL; e = idl_next(e)) {
    size_t same = 0;
    while (same < length && idl_identifier(e)[same] == first[same]) same++;
    length = same;
  }
  while (length > 0 && first[length - 1] != '_') length--;
  return length;
}

static idl_retcode_t emit_enum(const idl_pstate_t* pstate, bool revisit, const idl_path_t* path, const void* node,
                               void* user_data) {
  (void)pstate, (void)revisit, (void)path;
  FILE* out = user_data;
  const idl_enum_t* type = node;
  const idl_enumerator_t* e;
  open_namespace_with_alias(out, node);
  IDL_FOREACH(e, type->enumerators) {
    fprintf(out, "inline constexpr %s %s = ::", idl_identifier(node), idl_identifier(e));
    print_scope(out, node, "_");
    fprintf(out, "%s;\n", idl_identifier(e));
  }
  fputs("}\ntemplate <>\nstruct trivela::bus::enumeration<", out);
  print_cpp_name(out, node);
  fprintf(out, "> {\n  static constexpr std::string_view name = \"%s\";\n", idl_identifier(node));
  fputs("  static constexpr auto enumerators = std::to_array<Enumerator<", out);
  print_cpp_name(out, node);
  fputs(">>({\n", out);
  const size_t prefix = common_prefix(type);
  IDL_FOREACH(e, type->enumerators) {
    fputs("      {::", out);
    print_scope(out, node, "_");
    fprintf(out, "%s, \"", idl_identifier(e));
    for (const char* c = idl_identifier(e) + prefix; *c != '\0'; c++) fputc(tolower((unsigned char)*c), out);
    fputs("\"},\n", out);
  }
  fputs("  });\n};\n", out);
  return IDL_RETCODE_OK;
}

// The words of a text as a constant array.
static void emit_words(FILE* out, const char* name, const char* text) {
  fprintf(out, "  static constexpr auto %s = std::to_array<std::string_view>({", name);
  const char* separator = "";
  for (const char* word = text + strspn(text, " "); *word != '\0';) {
    const size_t length = strcspn(word, " ");
    fprintf(out, "%s\"%.*s\"", separator, (int)length, word);
    separator = ", ";
    word += length;
    word += strspn(word, " ");
  }
  fputs("});\n", out);
}

// What a struct says of its topic.
static idl_retcode_t emit_topic(const idl_pstate_t* pstate, FILE* out, const idl_struct_t* type) {
  const char* topic = annotation_text(&type->node, "topic_name");
  const char* profile = annotation_text(&type->node, "profile");
  const char* period = annotation_text(&type->node, "period");
  const char* writers = annotation_text(&type->node, "writers");
  if (topic == NULL || profile == NULL || *profile == '\0' || writers == NULL || *writers == '\0') {
    idl_error(pstate, idl_location(&type->node), "%s needs @topic_name, @profile and @writers, or @nested",
              idl_identifier(&type->node));
    return IDL_RETCODE_SEMANTIC_ERROR;
  }
  fprintf(out, "  static constexpr std::string_view topic = \"%s\";\n", topic);
  fprintf(out, "  static constexpr Profile profile = Profile::k%c%s;\n", toupper((unsigned char)profile[0]),
          profile + 1);
  emit_words(out, "writers", writers);
  fprintf(out, "  static constexpr double period_s = %s;\n", period ? period : "0");
  fputs("  static const dds_topic_descriptor_t& descriptor() { return ", out);
  print_c_name(out, &type->node);
  fputs("_desc; }\n", out);
  return IDL_RETCODE_OK;
}

static idl_retcode_t emit_struct(const idl_pstate_t* pstate, bool revisit, const idl_path_t* path, const void* node,
                                 void* user_data) {
  (void)revisit, (void)path;
  FILE* out = user_data;
  const idl_struct_t* type = node;
  const idl_member_t* m;
  const idl_declarator_t* d;
  open_namespace_with_alias(out, node);
  fputs("}\ntemplate <>\nstruct trivela::bus::meta<", out);
  print_cpp_name(out, node);
  fprintf(out, "> {\n  static constexpr std::string_view name = \"%s\";\n", idl_identifier(node));
  fputs("  static constexpr auto fields = std::to_array<Field>({\n", out);
  IDL_FOREACH(m, type->members) {
    IDL_FOREACH(d, m->declarators) {
      fprintf(out, "      {\"%s\", \"%s\", %s},\n", idl_identifier(d), m->unit.value ? m->unit.value : "",
              m->key.value ? "true" : "false");
    }
  }
  fputs("  });\n  static constexpr auto members = std::make_tuple(", out);
  const char* separator = "";
  IDL_FOREACH(m, type->members) {
    IDL_FOREACH(d, m->declarators) {
      fprintf(out, "%s&", separator);
      print_cpp_name(out, node);
      fprintf(out, "::%s", idl_identifier(d));
      separator = ", ";
    }
  }
  fputs(
      ");\n  template <class Message, class F>\n"
      "  static constexpr void visit(Message& message, F& f) {\n",
      out);
  size_t index = 0;
  IDL_FOREACH(m, type->members) {
    IDL_FOREACH(d, m->declarators) {
      fprintf(out, "    f(fields[%zu].name, fields[%zu].unit, message.%s);\n", index, index, idl_identifier(d));
      index++;
    }
  }
  fputs("  }\n", out);
  if (!type->nested.value) {
    const idl_retcode_t written = emit_topic(pstate, out, type);
    if (written != IDL_RETCODE_OK) return written;
  }
  fputs("};\n", out);
  return IDL_RETCODE_OK;
}

static idl_retcode_t emit_call(const idl_pstate_t* pstate, bool revisit, const idl_path_t* path, const void* node,
                               void* user_data) {
  (void)pstate, (void)revisit, (void)path;
  FILE* out = user_data;
  const idl_struct_t* type = node;
  if (type->nested.value) return IDL_RETCODE_OK;
  fputs("  f.template operator()<", out);
  print_cpp_name(out, node);
  fputs(">();\n", out);
  return IDL_RETCODE_OK;
}

int generate(const idl_pstate_t* pstate, const idlc_generator_config_t* config);
int generate(const idl_pstate_t* pstate, const idlc_generator_config_t* config) {
  const char* source = pstate->sources->path->name;
  char* target = NULL;
  if (idl_generate_out_file(source, config->output_dir, config->base_dir, "hpp", &target, 0) < 0) return -1;
  FILE* out = fopen(target, "w");
  free(target);
  if (out == NULL) return -1;
  const char* file = strrchr(source, '/') ? strrchr(source, '/') + 1 : source;
  fprintf(out,
          "// Generated from %s by idl/plugin.\n#pragma once\n#include \"idl/meta.hpp\"\n#include \"idl/%.*s.h\"\n",
          file, (int)strcspn(file, "."), file);
  for (const idl_source_t* i = pstate->sources->includes; i != NULL; i = i->next) {
    const char* included = strrchr(i->path->name, '/') ? strrchr(i->path->name, '/') + 1 : i->path->name;
    fprintf(out, "#include \"idl/%.*s.hpp\"\n", (int)strcspn(included, "."), included);
  }
  const char* sources[] = {source, NULL};
  idl_visitor_t visitor;
  memset(&visitor, 0, sizeof(visitor));
  visitor.visit = IDL_ENUM | IDL_STRUCT;
  visitor.sources = sources;
  visitor.accept[IDL_ACCEPT_ENUM] = emit_enum;
  visitor.accept[IDL_ACCEPT_STRUCT] = emit_struct;
  idl_retcode_t result = idl_visit(pstate, pstate->root, &visitor, out);
  fprintf(out,
          "\nnamespace trivela::bus {\n/// Calls f.operator()<T>() for each topic's type T of %s.\n"
          "template <class F>\nconstexpr void for_each_message_of_%.*s([[maybe_unused]] F&& f) {\n",
          file, (int)strcspn(file, "."), file);
  visitor.visit = IDL_STRUCT;
  visitor.accept[IDL_ACCEPT_STRUCT] = emit_call;
  if (result == IDL_RETCODE_OK) result = idl_visit(pstate, pstate->root, &visitor, out);
  fputs("}\n}\n", out);
  return (fclose(out) == 0 && result == IDL_RETCODE_OK) ? 0 : -1;
}
