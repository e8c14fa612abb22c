#include "history.hpp"

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

constexpr double side = 8.0;
constexpr Rectangle box{{0.0, 0.0}, {side, side}};

Context make_context(const Settings& settings) {
    return std::move(*Context::create_cpu(settings));
}

/// A number of vertices, sometimes too many for brute force.
int any_size(Random& random) {
    return random.whole(0, 3) == 0 ? random.whole(260, 500) : random.whole(3, 30);
}

/// Rings of many vertices in which eight edges that follow each other are small.
Rings smooth(Random& random) {
    Rings rings = random.whole(0, 1) == 0 ? coast(random, random.whole(260, 2600), 0.3)
                                          : regular(random.whole(260, 3000));
    if (random.whole(0, 2) == 0) {
        const Rings hole = random.whole(0, 1) == 0 ? regular(random.whole(3, 400)) : rings;
        rings.push_back(scaled_and_moved(hole, 0.6, {}).front());
    }
    return rings;
}

}  // namespace

History::History(std::uint64_t seed, std::function<QuestionList()> questions,
                 const Settings& settings)
    : random_(seed),
      make_questions_(std::move(questions)),
      questions_(make_questions_()),
      on_grid_(random_.whole(0, 3) == 0) {
    context_.emplace(make_context(settings));
    world_.emplace(std::move(*World::create(*context_)));
    asked_ = on_grid_ ? rectangle({0.0, 0.0}, {1.0, 1.0})
             : random_.whole(0, 2) == 0
                 ? scaled_and_moved(smooth(random_), 0.5, {})
                 : scaled_and_moved(star(random_, any_size(random_), 0.4), 0.5, {});
    asked_shape_ = *context_->add_shape(asked_);
    for (int i = random_.whole(1, 4); i > 0; --i) {
        add_shape();
    }
    for (int i = random_.whole(0, 25); i > 0; --i) {
        add();
    }
}

std::size_t History::any(std::size_t count) {
    return static_cast<std::size_t>(random_.whole(0, static_cast<int>(count) - 1));
}

Rings History::any_rings() {
    if (on_grid_) {
        return rectangle({0.0, 0.0}, {static_cast<double>(random_.whole(1, 3)),
                                      static_cast<double>(random_.whole(1, 2))});
    }
    switch (random_.whole(0, 7)) {
        case 0:
            return scaled_and_moved(with_holes(random_, random_.whole(1, 6)), 0.8, {});
        case 1:
            return several_parts(random_, random_.whole(2, 4));
        case 2:
            return spiky(random_, random_.whole(3, 8));
        case 3:
            return star(random_, random_.whole(260, 700), 0.5);  // too many for brute force
        case 4:
            return with_repeated_vertices(random_, star(random_, 12, 0.4), 0.4);
        case 5:
            return smooth(random_);
        default:
            return scaled_and_moved(star(random_, random_.whole(3, 40), 0.3),
                                    random_.scale(0.05, 1.5), {});
    }
}

Pose History::any_pose() {
    if (on_grid_) {
        return {
            {static_cast<double>(random_.whole(0, 7)), static_cast<double>(random_.whole(0, 7))},
            0.0};
    }
    const double off = random_.whole(0, 20) == 0 ? 1e4 : 0.0;
    return {{off + random_.between(0.0, side), random_.between(0.0, side)},
            random_.between(-3.0, 3.0)};
}

void History::require(const Status& status, const char* call) {
    if (!status.ok() && failure_.empty()) {
        failure_ = std::string(call) + ": " + status.text();
    }
}

void History::add_shape() {
    log_ += 'S';
    Rings rings = any_rings();
    const Expected<ShapeHandle> shape = context_->add_shape(rings);
    require(shape.has_value() ? Status() : shape.error(), "add_shape");
    shapes_.push_back({*shape, std::move(rings)});
}

void History::add() {
    const std::size_t shape = any(shapes_.size());
    if (!shapes_[shape].is_present) {
        return;
    }
    log_ += 'a';
    WorldInstance instance{shapes_[shape].handle, any_pose(),
                           static_cast<std::uint64_t>(random_.whole(0, 1000000))};
    if (random_.whole(0, 3) == 0) {
        instance.category = static_cast<std::uint32_t>(random_.whole(1, 15));
        instance.mask = static_cast<std::uint32_t>(random_.whole(0, 15));
    }
    const Expected<InstanceHandle> handle = world_->add(instance);
    require(handle.has_value() ? Status() : handle.error(), "add");
    members_.push_back({*handle, shape, instance});
}

void History::move_one() {
    log_ += 'm';
    Member& member = members_[any(members_.size())];
    if (random_.whole(0, 1) == 0) {
        member.instance.pose = any_pose();
    } else {
        member.instance.pose.translation.x += on_grid_ ? 1.0 : random_.between(-0.2, 0.2);
    }
    require(world_->move(member.handle, member.instance.pose), "move");
}

void History::move_many() {
    log_ += 'M';
    std::vector<InstanceHandle> handles;
    std::vector<Pose> poses;
    for (std::size_t i = any(2 * members_.size()) + 1; i > 0; --i) {
        Member& member = members_[any(members_.size())];  // some twice
        member.instance.pose = any_pose();
        handles.push_back(member.handle);
        poses.push_back(member.instance.pose);
    }
    require(world_->move(handles, poses), "move");
}

void History::deform() {
    KnownShape& shape = shapes_[any(shapes_.size())];
    if (!shape.is_present) {
        return;
    }
    log_ += 'd';
    for (Ring& ring : shape.rings) {
        for (Vector2& vertex : ring) {
            vertex.x += on_grid_ ? 0.0 : random_.between(-0.01, 0.01);
            vertex.y *= on_grid_ ? 2.0 : 1.01;
        }
    }
    require(context_->update_shape(shape.handle, shape.rings), "update_shape");
}

void History::replace() {
    KnownShape& shape = shapes_[any(shapes_.size())];
    if (!shape.is_present) {
        return;
    }
    log_ += 'D';
    shape.rings = any_rings();
    require(context_->update_shape(shape.handle, shape.rings), "update_shape");
}

void History::remove() {
    log_ += 'r';
    const std::size_t i = any(members_.size());
    require(world_->remove(members_[i].handle), "remove");
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(i));
}

void History::remove_shape() {
    KnownShape& shape = shapes_[any(shapes_.size())];
    if (!shape.is_present) {
        return;
    }
    log_ += 'R';
    require(context_->remove_shape(shape.handle), "remove_shape");
    shape.is_present = false;
    if (random_.whole(0, 1) == 0) {
        add_shape();  // takes the removed one's place
    }
}

void History::set_filter() {
    log_ += 'f';
    Member& member = members_[any(members_.size())];
    member.instance.category = static_cast<std::uint32_t>(random_.whole(0, 15));
    member.instance.mask = static_cast<std::uint32_t>(random_.whole(0, 15));
    require(world_->set_filter(member.handle, member.instance.category, member.instance.mask),
            "set_filter");
}

/// A member moves, in the next steps of time, to another place or to the one where it is.
void History::set_end() {
    log_ += 'e';
    Member& member = members_[any(members_.size())];
    member.end.reset();
    if (random_.whole(0, 2) > 0) {
        member.end = member.instance.pose;
        member.end->translation.x += on_grid_ ? random_.whole(-3, 3) : random_.between(-1.0, 1.0);
        member.end->angle += on_grid_ ? 0.0 : random_.whole(0, 1) * random_.between(-4.0, 4.0);
    }
}

/// Asks one thing, so that some of what is kept is made and the rest is not.
void History::glance() {
    log_ += 'q';
    Questions about = any_questions(random_, box, 3);
    about.shape = asked_shape_;
    Question& question = *questions_[any(questions_.size())];
    require(question.ask(*world_, about), question.name().c_str());
}

void History::step() {
    const int what = random_.whole(0, 99);
    if (what < 22 || members_.empty()) {
        add();
    } else if (what < 42) {
        move_one();
    } else if (what < 52) {
        move_many();
    } else if (what < 60) {
        deform();
    } else if (what < 64) {
        replace();
    } else if (what < 68) {
        set_end();
    } else if (what < 80) {
        remove();
    } else if (what < 82) {
        remove_shape();
    } else if (what < 86) {
        set_filter();
    } else if (what < 89) {
        add_shape();
    } else if (what < 92) {
        log_ += 't';
        world_->trim();
    } else {
        glance();
    }
}

/// The world knows its members as they are.
void History::check_members() {
    if (world_->size() != members_.size() && failure_.empty()) {
        failure_ = "size() is " + std::to_string(world_->size()) + " and there are " +
                   std::to_string(members_.size());
    }
    for (const Member& member : members_) {
        const Expected<WorldInstance> known = world_->instance(member.handle);
        const bool same = known.has_value() && known->user == member.instance.user &&
                          known->shape == member.instance.shape &&
                          known->pose.translation == member.instance.pose.translation &&
                          known->pose.angle == member.instance.pose.angle &&
                          known->category == member.instance.category &&
                          known->mask == member.instance.mask;
        if (!same && failure_.empty()) {
            failure_ = "instance() is not what was added";
        }
    }
}

std::string History::compare() {
    log_ += '?';
    check_members();
    Questions of_kept = any_questions(random_, box, 6);
    Questions of_fresh = of_kept;
    Context context = make_context({});
    World world = std::move(*World::create(context));
    of_kept.shape = asked_shape_;
    of_fresh.shape = *context.add_shape(asked_);
    // Of those whose shape is there, named by their position among them.
    std::vector<ShapeHandle> shapes(shapes_.size());
    std::vector<InstanceHandle> present;
    std::vector<InstanceHandle> handles;
    for (const Member& member : members_) {
        if (!shapes_[member.shape].is_present) {
            continue;
        }
        if (shapes[member.shape] == ShapeHandle()) {
            shapes[member.shape] = *context.add_shape(shapes_[member.shape].rings);
        }
        WorldInstance instance = member.instance;
        instance.shape = shapes[member.shape];
        present.push_back(member.handle);
        handles.push_back(*world.add(instance));
        if (member.end) {
            of_kept.moving.push_back(present.back());
            of_fresh.moving.push_back(handles.back());
            of_kept.ends.push_back(*member.end);
        }
    }
    of_fresh.ends = of_kept.ends;
    of_kept.list_pairs(present);
    of_fresh.list_pairs(handles);
    if (!present.empty() && random_.whole(0, 2) == 0) {
        const std::size_t ignored = any(present.size());
        of_kept.options.filter.ignored = present[ignored];
        of_fresh.options.filter.ignored = handles[ignored];
    }
    const auto position_in = [](const std::vector<InstanceHandle>& all) {
        return [&all](InstanceHandle handle) {
            const auto found = std::find(all.begin(), all.end(), handle);
            return handle == InstanceHandle() ? -1.0
                   : found == all.end()       ? -2.0
                                              : static_cast<double>(found - all.begin());
        };
    };
    Answers kept(position_in(present));
    Answers fresh(position_in(handles));
    kept.ask(questions_, *world_, of_kept);
    fresh.ask(make_questions_(), world, of_fresh);
    for (const std::unique_ptr<Question>& question : questions_) {
        kept_ += question->kept();
    }
    require(kept.status(), "a query of the world");
    require(fresh.status(), "a query of the new world");
    return failure_.empty() ? kept.difference_from(fresh) : failure_;
}

}  // namespace nearfield::test
