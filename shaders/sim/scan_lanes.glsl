// A prefix sum over the SCAN_LANES lanes of a work group.
shared uint laneTotals[SCAN_LANES];

// The sum of `total` over the lanes up to and with this one. To be called by every lane.
uint scanLanes(uint lane, uint total) {
  laneTotals[lane] = total;
  barrier();
  for (uint reach = 1u; reach < uint(SCAN_LANES); reach *= 2u) {
    uint left = lane >= reach ? laneTotals[lane - reach] : 0u;
    barrier();
    laneTotals[lane] += left;
    barrier();
  }
  return laneTotals[lane];
}
