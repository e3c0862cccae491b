#include "viewer/kept_panels.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <span>
#include <utility>

namespace clothsim {
namespace {

// By what its commands are clipped to, or else by where its vertices are: the background of a window is not
// clipped to it.
bool liesRightOf(float left, const ImDrawList& list) {
  return std::ranges::all_of(list.CmdBuffer, [&](const ImDrawCmd& command) {
    if (command.UserCallback != nullptr) return false;
    if (command.ClipRect.x >= left) return true;
    const std::span<const ImDrawIdx> corners(list.IdxBuffer.Data + command.IdxOffset, command.ElemCount);
    return std::ranges::all_of(corners, [&](ImDrawIdx i) {
      return list.VtxBuffer[static_cast<int>(command.VtxOffset + i)].pos.x >= left;
    });
  });
}

template <class Element>
void append(std::vector<std::byte>& bytes, std::span<const Element> elements) {
  const auto added = std::as_bytes(elements);
  bytes.insert(bytes.end(), added.begin(), added.end());
}

std::vector<std::byte> bytesOf(const std::vector<ImDrawList*>& lists) {
  std::vector<std::byte> bytes;
  for (const ImDrawList* list : lists) {
    append(bytes, std::span<const ImDrawVert>(list->VtxBuffer.Data, list->VtxBuffer.size()));
    append(bytes, std::span<const ImDrawIdx>(list->IdxBuffer.Data, list->IdxBuffer.size()));
    // Member by member: between them lie bytes without a meaning.
    for (const ImDrawCmd& command : list->CmdBuffer) {
      append(bytes, std::span(&command.ClipRect, 1));
      append(bytes, std::span(&command.TextureId, 1));
      append(bytes, std::span(&command.ElemCount, 1));
      append(bytes, std::span(&command.IdxOffset, 1));
      append(bytes, std::span(&command.VtxOffset, 1));
    }
  }
  return bytes;
}

void drawLists(const ImDrawData& data, std::vector<ImDrawList*>& lists) {
  ImDrawData part = data;
  part.CmdLists = lists.data();
  part.CmdListsCount = static_cast<int>(lists.size());
  ImGui_ImplOpenGL3_RenderDrawData(&part);
}

}  // namespace

void KeptPanels::draw(const ImDrawData& data, float left, bool isNew) {
  std::vector<ImDrawList*> lists(data.CmdLists, data.CmdLists + data.CmdListsCount);
  const auto others =
      std::ranges::stable_partition(lists, [&](const ImDrawList* list) { return liesRightOf(left, *list); });
  std::vector<ImDrawList*> over(others.begin(), others.end());
  lists.erase(others.begin(), others.end());

  const gl::FramebufferFormat format{.width = static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
                                     .height = static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y),
                                     .color = GL_RGBA8};
  const int from = static_cast<int>(left);
  if (!lists.empty() && from < format.width) {
    if (!(kept_.format() == format)) {
      drawing_ = gl::Framebuffer("panels", format);
      kept_ = gl::Framebuffer("kept panels", format);
      forget();
    }
    if (isNew || drawn_.empty()) {
      std::vector<std::byte> wanted = bytesOf(lists);
      if (wanted != drawn_) {
        drawing_.bind();
        drawLists(data, lists);
        copier_.run(drawing_, kept_, {from, 0, format.width, format.height}, true);
        gl::bindFramebuffer(0);
        drawn_ = std::move(wanted);
      }
    }
    kept_.showColumns(from);
  }
  drawLists(data, over);
}

}  // namespace clothsim
