#undef LAW
#undef precise
#undef vec3
