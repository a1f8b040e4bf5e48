// The template of the viewer, included into the library by the assembler.
#include "floatframe/page/page_writer.hpp"

asm(".pushsection .rodata\n"
    ".globl floatframe_page_template\n"
    ".hidden floatframe_page_template\n"
    ".globl floatframe_page_template_end\n"
    ".hidden floatframe_page_template_end\n"
    "floatframe_page_template:\n"
    ".incbin \"" FLOATFRAME_VIEWER_TEMPLATE
    "\"\n"
    "floatframe_page_template_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" const char floatframe_page_template[], floatframe_page_template_end[];

namespace floatframe {

std::string_view page_template() noexcept {
  return {floatframe_page_template,
          static_cast<std::size_t>(floatframe_page_template_end - floatframe_page_template)};
}

}  // namespace floatframe
