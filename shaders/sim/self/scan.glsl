// A prefix sum over the lanes of a work group.
shared uint laneTotals[HASH_GROUP];

// The sum of `total` over the lanes up to and with this one. To be called by every lane.
uint scanLanes(uint lane, uint total) {
  laneTotals[lane] = total;
  barrier();
  for (uint reach = 1u; reach < uint(HASH_GROUP); reach *= 2u) {
    uint left = lane >= reach ? laneTotals[lane - reach] : 0u;
    barrier();
    laneTotals[lane] += left;
    barrier();
  }
  return laneTotals[lane];
}
