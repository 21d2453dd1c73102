#pragma once
// Values of property tags.
#include <pugixml.hpp>

#include "core/maths.h"
#include "scene/xml/document.h"

namespace facet {

/// The element's attribute; an error where it is missing.
[[nodiscard]] std::string required_attribute(const XmlDocument& xml, const pugi::xml_node& node,
                                             const char* name);

/// The attribute `value` without blanks around it.
[[nodiscard]] std::string required_word(const XmlDocument& xml, const pugi::xml_node& node);

/// The attribute as `least` to `most` numbers.
[[nodiscard]] std::vector<double> read_numbers(const XmlDocument& xml, const pugi::xml_node& node,
                                               const char* attribute, std::size_t least,
                                               std::size_t most);

/// Three numbers.
[[nodiscard]] dvec3 read_vector(const XmlDocument& xml, const pugi::xml_node& node,
                                const char* attribute);

/// A <transform>: its steps in order, each multiplied on the left.
[[nodiscard]] dmat4 read_transform(const XmlDocument& xml, const pugi::xml_node& node);

}  // namespace facet
